// SPDX-License-Identifier: MIT
#include <libusb.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/falcon/falcon_port.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {
namespace {

constexpr std::uint16_t kFalconVendor = 0x0403, kFalconProduct = 0xcb48;
constexpr unsigned char kEndpointOut = 0x02, kEndpointIn = 0x81;
constexpr std::uint8_t kVendorRequest = 0x40;  // to the device, of its maker's own kind

unsigned int as_usb_time(Nanoseconds time_ns) {
    // 0 would be without an end.
    return static_cast<unsigned int>(std::max<Nanoseconds>((time_ns + 999'999) / 1'000'000, 1));
}

// libusb itself, while any port or look is alive.
class Usb {
public:
    static Result<std::shared_ptr<Usb>> open() {
        libusb_context* context = nullptr;
        if (const int code = ::libusb_init(&context); code != 0)
            return fail("haptic device falcon", std::string("USB cannot be looked through: ") + ::libusb_strerror(code),
                        "see that /dev/bus/usb is there");
        return std::shared_ptr<Usb>(new Usb(context));
    }
    ~Usb() { ::libusb_exit(context_); }
    Usb(const Usb&) = delete;
    Usb& operator=(const Usb&) = delete;
    [[nodiscard]] libusb_context* context() const { return context_; }

private:
    explicit Usb(libusb_context* context) : context_(context) {}
    libusb_context* context_;
};

// All devices on USB, while it lives.
class UsbList {
public:
    explicit UsbList(libusb_context* context) : count_(::libusb_get_device_list(context, &devices_)) {}
    ~UsbList() {
        if (devices_ != nullptr) ::libusb_free_device_list(devices_, 1);
    }
    UsbList(const UsbList&) = delete;
    UsbList& operator=(const UsbList&) = delete;
    [[nodiscard]] std::span<libusb_device* const> falcons() {
        for (ssize_t i = 0; i < count_; ++i) {
            libusb_device_descriptor about{};
            if (::libusb_get_device_descriptor(devices_[i], &about) != 0) continue;
            if (about.idVendor == kFalconVendor && about.idProduct == kFalconProduct) falcons_.push_back(devices_[i]);
        }
        return falcons_;
    }

private:
    libusb_device** devices_ = nullptr;
    ssize_t count_;
    std::vector<libusb_device*> falcons_;
};

// Where it is plugged in, which stays the same when it is plugged in there again: "1-4.2".
std::string place_of(libusb_device* device) {
    std::array<std::uint8_t, 8> ports{};
    const int count = ::libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
    std::string place = std::to_string(::libusb_get_bus_number(device)) + "-";
    for (int i = 0; i < count; ++i) place += (i > 0 ? "." : "") + std::to_string(ports[static_cast<std::size_t>(i)]);
    if (count <= 0) place += std::to_string(::libusb_get_device_address(device));
    return place;
}
std::string file_of(libusb_device* device) {
    return formatted("/dev/bus/usb/%03d/%03d", ::libusb_get_bus_number(device), ::libusb_get_device_address(device));
}

class UsbFalconPort final : public FalconPort {
public:
    UsbFalconPort(std::shared_ptr<Usb> usb, libusb_device_handle* device) : usb_(std::move(usb)), device_(device) {}
    ~UsbFalconPort() override {
        ::libusb_release_interface(device_, 0);
        ::libusb_close(device_);
    }
    [[nodiscard]] Cable request(FtdiRequest what, std::uint16_t value) noexcept override {
        constexpr unsigned int kWithin_ms = 1000;
        const int done = ::libusb_control_transfer(device_, kVendorRequest, static_cast<std::uint8_t>(what), value, 0,
                                                   nullptr, 0, kWithin_ms);
        return cable_by(done < 0 ? done : 0);
    }
    [[nodiscard]] Cable write(std::span<const std::byte> bytes, Nanoseconds within_ns) noexcept override {
        int written = 0;
        // libusb does not write to what it sends.
        auto* const from = reinterpret_cast<unsigned char*>(const_cast<std::byte*>(bytes.data()));
        const int done = ::libusb_bulk_transfer(device_, kEndpointOut, from, static_cast<int>(bytes.size()), &written,
                                                as_usb_time(within_ns));
        if (done == 0 && written != static_cast<int>(bytes.size())) return Cable::late;
        return cable_by(done);
    }
    [[nodiscard]] Cable read(std::span<std::byte, kFtdiPiece> piece, std::size_t& count,
                             Nanoseconds within_ns) noexcept override {
        int came = 0;
        const int done = ::libusb_bulk_transfer(device_, kEndpointIn, reinterpret_cast<unsigned char*>(piece.data()),
                                                static_cast<int>(piece.size()), &came, as_usb_time(within_ns));
        count = static_cast<std::size_t>(std::max(came, 0));
        return count > 0 ? Cable::well : cable_by(done);
    }

private:
    static Cable cable_by(int code) {
        if (code == 0) return Cable::well;
        return code == LIBUSB_ERROR_TIMEOUT || code == LIBUSB_ERROR_INTERRUPTED ? Cable::late : Cable::pulled;
    }

    std::shared_ptr<Usb> usb_;
    libusb_device_handle* device_;
};

}  // namespace

Result<std::unique_ptr<FalconPort>> open_usb_falcon(const std::string& place) {
    const std::string where = "haptic device falcon" + (place.empty() ? std::string() : " " + place);
    BURIN_TRY(usb, Usb::open());
    UsbList list(usb->context());
    libusb_device* found = nullptr;
    for (libusb_device* const device : list.falcons())
        if (found == nullptr && (place.empty() || place_of(device) == place)) found = device;
    if (found == nullptr)
        return fail(where, place.empty() ? "there is none on USB (0403:cb48)" : "there is none at this place of USB",
                    "plug it in and switch its power on; burin devices lists those that are there; or try an emulated "
                    "one: burin devices emulate falcon");
    libusb_device_handle* device = nullptr;
    const int opened = ::libusb_open(found, &device);
    if (opened == LIBUSB_ERROR_ACCESS)
        return fail(where, file_of(found) + " may not be opened by this user", udev_remedy());
    if (opened != 0)
        return fail(where, std::string("cannot be opened: ") + ::libusb_strerror(opened), "plug it in again");
    // A kernel that knows the chip would offer it as a serial line: it lets go while the port is open.
    ::libusb_set_auto_detach_kernel_driver(device, 1);
    if (const int claimed = ::libusb_claim_interface(device, 0); claimed != 0) {
        ::libusb_close(device);
        return fail(where,
                    claimed == LIBUSB_ERROR_BUSY ? "is in use by another program"
                                                 : std::string("cannot be claimed: ") + ::libusb_strerror(claimed),
                    "end the other program, or plug the device in again");
    }
    return std::make_unique<UsbFalconPort>(std::move(usb), device);
}

std::vector<DevicePresence> look_for_usb_falcons() {
    auto usb = Usb::open();
    if (!usb) return {{Presence::absent, "falcon", usb.error().what, usb.error().remedy}};
    std::vector<DevicePresence> found;
    UsbList list((*usb)->context());
    for (libusb_device* const device : list.falcons()) {
        const std::string name = "falcon:" + place_of(device), file = file_of(device);
        if (::access(file.c_str(), R_OK | W_OK) == 0)
            found.push_back({Presence::there,
                             name,
                             "a Novint Falcon at " + file +
                                 "; one that was just switched on wants its firmware: " + name + "@FIRMWARE",
                             {}});
        else
            found.push_back({Presence::forbidden, name, file + " may not be opened by this user", udev_remedy()});
    }
    if (found.empty())
        found.push_back({Presence::absent, "falcon", "there is no Novint Falcon on USB (0403:cb48)",
                         "plug it in and switch its power on, or burin devices emulate falcon"});
    return found;
}

}  // namespace burin::devices
