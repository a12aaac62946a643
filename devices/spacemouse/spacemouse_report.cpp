// SPDX-License-Identifier: MIT
#include "devices/spacemouse/spacemouse_report.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

constexpr std::uint16_t kLogitech = 0x046d, kConnexion = 0x256f;
constexpr std::array kProducts{
    SpaceMouseProduct{kLogitech, 0xc603, "SpaceMouse Plus XT", SpaceMouseKeys::plain, false, SpaceMouseAxes::y_up},
    SpaceMouseProduct{kLogitech, 0xc605, "CADMan"},
    SpaceMouseProduct{kLogitech, 0xc606, "SpaceMouse Classic", SpaceMouseKeys::plain, false, SpaceMouseAxes::y_up},
    SpaceMouseProduct{kLogitech, 0xc621, "SpaceBall 5000"},
    SpaceMouseProduct{kLogitech, 0xc623, "SpaceTraveler"},
    SpaceMouseProduct{kLogitech, 0xc625, "SpacePilot"},
    SpaceMouseProduct{kLogitech, 0xc626, "SpaceNavigator"},
    SpaceMouseProduct{kLogitech, 0xc627, "SpaceExplorer"},
    SpaceMouseProduct{kLogitech, 0xc628, "SpaceNavigator for Notebooks"},
    SpaceMouseProduct{kLogitech, 0xc629, "SpacePilot Pro"},
    SpaceMouseProduct{kLogitech, 0xc62b, "SpaceMouse Pro", SpaceMouseKeys::pro},
    SpaceMouseProduct{kConnexion, 0xc62e, "SpaceMouse Wireless", SpaceMouseKeys::plain, true},
    SpaceMouseProduct{kConnexion, 0xc62f, "SpaceMouse Wireless receiver", SpaceMouseKeys::plain, true},
    SpaceMouseProduct{kConnexion, 0xc631, "SpaceMouse Pro Wireless", SpaceMouseKeys::pro, true},
    SpaceMouseProduct{kConnexion, 0xc632, "SpaceMouse Pro Wireless receiver", SpaceMouseKeys::pro, true},
    SpaceMouseProduct{kConnexion, 0xc633, "SpaceMouse Enterprise", SpaceMouseKeys::pro, true},
    SpaceMouseProduct{kConnexion, 0xc635, "SpaceMouse Compact"},
    SpaceMouseProduct{kConnexion, 0xc636, "SpaceMouse Module"},
    SpaceMouseProduct{kConnexion, 0xc638, "SpaceMouse Pro Wireless BT", SpaceMouseKeys::pro, true},
    SpaceMouseProduct{kConnexion, 0xc63a, "SpaceMouse Wireless BT", SpaceMouseKeys::plain, true},
    SpaceMouseProduct{kConnexion, 0xc652, "Universal Receiver", SpaceMouseKeys::receiver, true},
};

constexpr std::size_t kOneTriple = 7, kTwoTriples = 13;

// The bits of a mask in the order of the buttons, of devices whose keys stand apart in it.
constexpr std::array<std::uint8_t, 15> kProOrder{12, 13, 14, 15, 0, 1, 2, 4, 5, 8, 26, 22, 23, 24, 25};

bool is_set(std::span<const std::byte> mask, std::size_t bit) {
    return bit / 8 < mask.size() && (mask[bit / 8] >> (bit % 8) & std::byte{1}) != std::byte{0};
}

std::uint32_t buttons_in(std::span<const std::byte> mask, SpaceMouseKeys keys) {
    std::uint32_t buttons = 0;
    const auto take = [&](std::size_t button, std::size_t bit) {
        if (is_set(mask, bit)) buttons |= 1u << button;
    };
    if (keys == SpaceMouseKeys::pro)
        for (std::size_t i = 0; i < kProOrder.size(); ++i) take(i, kProOrder[i]);
    else
        for (std::size_t bit = 0; bit < 32; ++bit) take(bit, bit);
    if (keys == SpaceMouseKeys::receiver) {
        // The two keys of a small device, or 1 to 4 of a large one.
        buttons &= 3u;
        for (std::size_t i = 0; i < 4; ++i) take(i, kProOrder[i]);
    }
    return buttons;
}

// Three numbers of 16 bits in the axes of a report, as a share of full deflection in the device frame.
Vec3 triple_at(std::span<const std::byte> bytes, SpaceMouseAxes axes) {
    Vec3 hid(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto low = static_cast<std::uint16_t>(bytes[static_cast<std::size_t>(2 * axis)]);
        const auto high = static_cast<std::uint16_t>(bytes[static_cast<std::size_t>(2 * axis + 1)]);
        const auto number = static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
        hid[axis] = std::clamp(number / kSpaceMouseFull, -1.0, 1.0);
    }
    return axes == SpaceMouseAxes::y_up ? Vec3(hid.x, hid.y, -hid.z) : Vec3(hid.x, -hid.z, hid.y);
}

}  // namespace

std::span<const SpaceMouseProduct> spacemouse_products() { return kProducts; }

std::optional<SpaceMouseProduct> spacemouse_product(std::uint16_t vendor, std::uint16_t product) {
    const auto is_it = [&](const SpaceMouseProduct& p) { return p.vendor == vendor && p.product == product; };
    if (const auto known = std::ranges::find_if(kProducts, is_it); known != kProducts.end()) return *known;
    constexpr std::uint16_t kNone = 0xc641;
    if (vendor == kConnexion && product != kNone) return SpaceMouseProduct{vendor, product, "3Dconnexion device"};
    return std::nullopt;
}

std::optional<SpaceMouseReport> spacemouse_report(std::span<const std::byte> bytes, SpaceMouseKeys keys,
                                                  SpaceMouseAxes axes) {
    if (bytes.empty()) return std::nullopt;
    SpaceMouseReport report;
    switch (std::to_integer<int>(bytes[0])) {
        case 1:
            if (bytes.size() != kOneTriple && bytes.size() != kTwoTriples) return std::nullopt;
            report.push = triple_at(bytes.subspan(1), axes);
            if (bytes.size() == kTwoTriples) report.turn = triple_at(bytes.subspan(kOneTriple), axes);
            break;
        case 2:
            if (bytes.size() != kOneTriple) return std::nullopt;
            report.turn = triple_at(bytes.subspan(1), axes);
            break;
        case 3:
            if (bytes.size() < 2 || bytes.size() > kMostHidReport) return std::nullopt;
            report.buttons = buttons_in(bytes.subspan(1), keys);
            break;
        default: break;
    }
    return report;
}

bool is_multi_axis(std::span<const std::byte> descriptor) {
    constexpr std::array kBegin{std::byte{0x05}, std::byte{0x01}, std::byte{0x09}, std::byte{0x08}};
    return descriptor.size() >= kBegin.size() && std::ranges::equal(descriptor.first(kBegin.size()), kBegin);
}

}  // namespace burin::devices
