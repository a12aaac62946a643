// SPDX-License-Identifier: MIT
#include "devices/drivers/wand_device.hpp"

#include <memory>
#include <utility>

#include "base/try.hpp"
#include "devices/drivers/hil_wand.hpp"
#include "devices/drivers/library_beside.hpp"
#include "devices/drivers/wand_hardware.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/presence/hil_shared.hpp"

namespace burin::devices {
namespace {

// A wand that is nowhere, with the description whose text its device points to.
class RestingWand final : public HapticDevice, public Amplifiers {
public:
    RestingWand(WandDescription wand, Clock& clock) : wand_(std::move(wand)), clock_(clock) {}
    [[nodiscard]] const DeviceDescription& description() const noexcept override { return device_; }
    [[nodiscard]] DeviceSample read() noexcept override {
        DeviceSample sample;
        sample.time_ns = clock_.now_ns();
        return sample;
    }
    void write(const DeviceWrench& /*wrench*/) noexcept override {}
    [[nodiscard]] AmplifierAnswer switch_amplifiers(bool /*on*/) noexcept override { return AmplifierAnswer::done; }

private:
    WandDescription wand_;
    DeviceDescription device_ = device_of_hardware(wand_);
    Clock& clock_;
};

}  // namespace

WandAddress wand_address(const std::string& text) {
    WandAddress address;
    std::string rest = text;
    // A card on another machine has its address behind a sign of the same kind.
    if (const std::size_t at = rest.rfind('@'); at != std::string::npos && !rest.substr(at).contains("://")) {
        address.library = rest.substr(at + 1);
        address.names_library = true;
        rest.resize(at);
    }
    if (rest.ends_with(".toml")) {
        const std::size_t comma = rest.find(',');
        address.file = comma == std::string::npos ? rest : rest.substr(comma + 1);
        rest.resize(comma == std::string::npos ? 0 : comma);
    }
    if (!rest.empty()) address.card = rest;
    return address;
}

Result<WandDescription> wand_at(const std::string& text) {
    const WandAddress address = wand_address(text);
    if (address.file.empty()) return quanser_wand_of_maker();
    return read_wand(address.file, quanser_wand_of_maker());
}

Result<void> check_wand(const std::string& text) { return check_library_named("haptic device wand:" + text, text); }

Result<OpenedDevice> open_wand(const std::string& text, AnyHand hand, Clock& clock) {
    const WandAddress address = wand_address(text);
    auto wand = wand_at(text);
    if (!wand) return std::unexpected(wand.error());
    BURIN_TRY(library, library_chosen("haptic device wand:" + text, address.names_library, address.library,
                                      address.card, kEmulatedHilLibrary, kHilLibrary));
    BURIN_TRY(served, HilWand::open(library, address.card, *wand));
    Amplifiers* const amplifiers = served.get();
    const DeviceDescription description = served->description();
    OpenedDevice opened = served_arm(std::move(served), description, std::move(hand), clock);
    opened.amplifiers = amplifiers;
    return opened;
}

Result<OpenedDevice> wand_that_rests(const std::string& text, Clock& clock) {
    BURIN_TRY(wand, wand_at(text));
    auto device = std::make_unique<RestingWand>(std::move(wand), clock);
    Amplifiers* const amplifiers = device.get();
    return of_one_part(std::move(device), amplifiers);
}

std::vector<DevicePresence> look_for_wands() {
    std::vector<DevicePresence> found;
    if (auto api = load_hil_api(kHilLibrary); api)
        found.push_back(
            {Presence::perhaps,
             kHilWand,
             "Quanser's HIL library is installed; whether a card and a wand are there shows when it is opened",
             {}});
    else
        found.push_back({api.error().what.contains("cannot be loaded") ? Presence::absent : Presence::unusable,
                         kHilWand, api.error().what, api.error().remedy});
    for (const std::string& name : emulated_wands())
        found.push_back({Presence::there, std::string(kHilWand) + ":" + name, "an emulated one", {}});
    return found;
}

}  // namespace burin::devices
