// SPDX-License-Identifier: MIT
#include "devices/presence/usb_presence.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/places.hpp"
#include "base/text.hpp"

namespace burin::devices {
namespace {

std::string shown_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::optional<int> shown_number(const std::filesystem::path& path, int base) {
    const std::string text = shown_text(path);
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    return error == std::errc{} ? std::optional(number) : std::nullopt;
}

ShownDevice shown_at(const std::filesystem::path& file, int product) {
    return {file, static_cast<std::uint16_t>(product),
            ::faccessat(AT_FDCWD, file.c_str(), R_OK | W_OK, AT_EACCESS) == 0};
}

}  // namespace

std::vector<ShownDevice> shown_devices_of(std::uint16_t vendor, const KernelPlaces& places) {
    std::vector<ShownDevice> found;
    for (const auto& entry : entries_of(places.usb).value_or(std::vector<std::filesystem::path>())) {
        const auto maker = shown_number(entry / "idVendor", 16), product = shown_number(entry / "idProduct", 16);
        const auto bus = shown_number(entry / "busnum", 10), number = shown_number(entry / "devnum", 10);
        if (maker != int{vendor} || !product || !bus || !number) continue;
        found.push_back(shown_at(places.usb_files / formatted("%03d", *bus) / formatted("%03d", *number), *product));
    }
    for (const auto& entry : entries_of(places.hidraw).value_or(std::vector<std::filesystem::path>())) {
        // "HID_ID=0003:00002988:00000304": bus, vendor, product.
        const std::string about = shown_text(entry / "device" / "uevent");
        constexpr std::string_view kKey = "HID_ID=";
        const std::size_t at = about.find(kKey);
        unsigned int bus = 0, maker = 0, product = 0;
        if (at == std::string::npos ||
            std::sscanf(about.c_str() + at + kKey.size(), "%x:%x:%x", &bus, &maker, &product) != 3)  // NOLINT
            continue;
        if (maker == vendor)
            found.push_back(shown_at(places.hidraw_files / entry.filename(), static_cast<int>(product)));
    }
    return found;
}

std::string forbidden_among(const std::vector<ShownDevice>& devices) {
    std::string files;
    for (const ShownDevice& device : devices)
        if (!device.may_be_opened) files += (files.empty() ? "" : ", ") + device.file.string();
    return files;
}

}  // namespace burin::devices
