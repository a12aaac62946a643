// SPDX-License-Identifier: MIT
// The rules by which Linux lets a person open devices, read as udev reads them: keys that are compared, with shell
// patterns and alternatives, of which those with an S at their end have to hold of one and the same parent. And what is
// told where they are missing.
#include <fnmatch.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/assets.hpp"
#include "devices/drivers/dhd_device.hpp"
#include "devices/drivers/omni_device.hpp"
#include "devices/presence/udev_rules.hpp"
#include "devices/presence/usb_presence.hpp"

namespace burin::devices {
namespace {

using UdevKeys = std::map<std::string, std::string>;

// A device as udev has it: its own keys ("SUBSYSTEM", "ATTR{idVendor}"), and those of each of its parents ("KERNELS").
struct UdevDevice {
    UdevKeys own;
    std::vector<UdevKeys> parents;
};

struct UdevTerm {
    std::string key, means, value;
};

// KEY=="VALUE", KEY="VALUE", KEY+="VALUE", with commas between them.
std::vector<UdevTerm> terms_of(const std::string& line) {
    std::vector<UdevTerm> terms;
    for (std::size_t at = 0; at < line.size();) {
        const std::size_t means = line.find_first_of("=+", at), open = line.find('"', at);
        const std::size_t close = line.find('"', open + 1);
        if (open == std::string::npos || close == std::string::npos) break;
        terms.push_back(
            {line.substr(at, means - at), line.substr(means, open - means), line.substr(open + 1, close - open - 1)});
        at = line.find_first_not_of(", ", close + 1);
    }
    return terms;
}

bool matches(const UdevKeys& keys, const UdevTerm& term) {
    const auto found = keys.find(term.key);
    if (found == keys.end()) return false;
    std::string patterns = term.value + "|";
    for (std::size_t at = 0, bar = patterns.find('|'); bar != std::string::npos;
         at = bar + 1, bar = patterns.find('|', at))
        if (::fnmatch(patterns.substr(at, bar - at).c_str(), found->second.c_str(), 0) == 0) return true;
    return false;
}

bool is_of_parents(const std::string& key) {
    const std::string name = key.substr(0, key.find('{'));
    return name == "ATTRS" || name == "KERNELS" || name == "SUBSYSTEMS";
}

// What the rules do with a device: "TAG+=uaccess", "ENV{ID_MM_PORT_IGNORE}=1".
std::string done_by_rules(const UdevDevice& device) {
    std::ifstream rules(asset_path("devices/" + std::string(kUdevRules)));
    EXPECT_TRUE(rules.good());
    std::string done;
    for (std::string line; std::getline(rules, line);) {
        if (line.empty() || line.starts_with('#')) continue;
        std::vector<UdevTerm> of_parents;
        std::string does;
        bool holds = true;
        for (const UdevTerm& term : terms_of(line)) {
            if (term.means != "==")
                does += term.key + term.means + term.value + "\n";
            else if (is_of_parents(term.key))
                of_parents.push_back(term);
            else
                holds = holds && matches(device.own, term);
        }
        bool any_parent = of_parents.empty();
        for (const UdevKeys& parent : device.parents) {
            bool all = true;
            for (const UdevTerm& term : of_parents) all = all && matches(parent, term);
            any_parent = any_parent || all;
        }
        if (holds && any_parent) done += does;
    }
    return done;
}

bool may_be_opened(const UdevDevice& device) { return done_by_rules(device).contains("TAG+=uaccess"); }

UdevDevice usb_device(const std::string& vendor, const std::string& product) {
    return {{{"SUBSYSTEM", "usb"},
             {"ENV{DEVTYPE}", "usb_device"},
             {"ATTR{idVendor}", vendor},
             {"ATTR{idProduct}", product}},
            {}};
}

// On USB its maker's numbers are attributes of a parent; by Bluetooth there is no such parent.
UdevDevice hid_device(const std::string& parent, const std::string& vendor = "", const std::string& product = "") {
    UdevDevice device{{{"SUBSYSTEM", "hidraw"}, {"KERNEL", "hidraw3"}}, {{{"KERNELS", parent}, {"SUBSYSTEMS", "hid"}}}};
    if (!vendor.empty())
        device.parents.push_back(
            {{"KERNELS", "1-4"}, {"ATTRS{idVendor}", vendor}, {"ATTRS{idProduct}", product}, {"SUBSYSTEMS", "usb"}});
    return device;
}

UdevDevice serial_line(const std::string& kernel, const std::string& vendor) {
    return {{{"SUBSYSTEM", "tty"}, {"KERNEL", kernel}},
            {{{"KERNELS", "1-2"}, {"ATTRS{idVendor}", vendor}, {"SUBSYSTEMS", "usb"}}}};
}

// Folders as the kernel's, while they live.
class KernelFolders {
public:
    KernelFolders() : root_(std::filesystem::temp_directory_path() / ("burin-kernel-" + std::to_string(::getpid()))) {
        places_ = {root_ / "usb", root_ / "bus", root_ / "hidraw", root_ / "dev"};
        for (const auto& folder : {places_.usb, places_.usb_files / "001", places_.hidraw, places_.hidraw_files})
            std::filesystem::create_directories(folder);
    }
    ~KernelFolders() {
        std::error_code ignored;
        std::filesystem::remove_all(root_, ignored);
    }
    void add_usb(const std::string& vendor, int number) const {
        const auto folder = places_.usb / ("1-" + std::to_string(number));
        std::filesystem::create_directories(folder);
        for (const auto& [name, text] : {std::pair<std::string, std::string>{"idVendor", vendor},
                                         {"idProduct", "0302"},
                                         {"busnum", "1"},
                                         {"devnum", std::to_string(number)}})
            std::ofstream(folder / name) << text << "\n";
        std::ofstream(places_.usb_files / "001" / ("00" + std::to_string(number)));
    }
    void add_hid(const std::string& name, const std::string& id) const {
        std::filesystem::create_directories(places_.hidraw / name / "device");
        std::ofstream(places_.hidraw / name / "device" / "uevent") << "DRIVER=hid-generic\nHID_ID=" << id << "\n";
        std::ofstream(places_.hidraw_files / name).flush();
    }
    void shut(const std::filesystem::path& file) const {
        std::filesystem::permissions(file, std::filesystem::perms::none);
    }
    [[nodiscard]] const KernelPlaces& places() const { return places_; }

private:
    std::filesystem::path root_;
    KernelPlaces places_;
};

// An administrator may open every file: while this lives the process is nobody in particular.
class AsNobody {
public:
    AsNobody() { EXPECT_TRUE(was_ != 0 || ::seteuid(65534) == 0); }
    ~AsNobody() { EXPECT_TRUE(was_ != 0 || ::seteuid(was_) == 0); }
    AsNobody(const AsNobody&) = delete;
    AsNobody& operator=(const AsNobody&) = delete;

private:
    uid_t was_ = ::geteuid();
};

const DevicePresence* forbidden_of(const std::vector<DevicePresence>& found) {
    for (const DevicePresence& one : found)
        if (one.presence == Presence::forbidden) return &one;
    return nullptr;
}

}  // namespace

TEST(UdevRules, LetAPersonOpenEachDeviceThatThereIsADriverFor) {
    EXPECT_TRUE(may_be_opened(usb_device("0403", "cb48"))) << "Novint Falcon";
    EXPECT_TRUE(may_be_opened(usb_device("1451", "0402"))) << "Force Dimension";
    EXPECT_TRUE(may_be_opened(usb_device("2988", "0302"))) << "Touch on USB";
    EXPECT_TRUE(may_be_opened(hid_device("0003:2988:0304.0001", "2988", "0304"))) << "the Touch that is sold today";
    EXPECT_TRUE(may_be_opened(hid_device("0003:256F:C635.0002", "256f", "c635"))) << "SpaceMouse Compact";
    EXPECT_TRUE(may_be_opened(hid_device("0003:046D:C62B.0003", "046d", "c62b"))) << "SpaceMouse Pro";
    EXPECT_TRUE(may_be_opened(hid_device("0005:256F:C63A.0004"))) << "SpaceMouse by Bluetooth";
    EXPECT_TRUE(may_be_opened(serial_line("ttyUSB0", "0403")));
    EXPECT_TRUE(may_be_opened(serial_line("ttyACM1", "2341")));
}

TEST(UdevRules, LeaveOtherDevicesAlone) {
    EXPECT_FALSE(may_be_opened(usb_device("0403", "6001"))) << "another device of FTDI's chip";
    EXPECT_FALSE(may_be_opened(hid_device("0003:046D:C077.0005", "046d", "c077"))) << "a plain mouse";
    EXPECT_FALSE(may_be_opened(hid_device("0005:046D:B023.0006"))) << "a plain mouse by Bluetooth";
    EXPECT_FALSE(may_be_opened(serial_line("ttyS0", "0403")));
}

TEST(UdevRules, HideSerialAdaptersFromModemManagerAndNoModem) {
    for (const std::string vendor : {"0403", "067b", "10c4", "1a86"})
        EXPECT_TRUE(done_by_rules(serial_line("ttyUSB0", vendor)).contains("ENV{ID_MM_PORT_IGNORE}=1")) << vendor;
    EXPECT_FALSE(done_by_rules(serial_line("ttyUSB0", "12d1")).contains("ID_MM")) << "a modem";
}

TEST(UdevRules, AreNamedWhereADeviceOfAMakersLibraryMayNotBeOpened) {
    const KernelFolders kernel;
    kernel.add_usb("1451", 4);
    kernel.add_usb("2988", 5);
    kernel.add_usb("1d6b", 1);
    kernel.add_hid("hidraw7", "0003:00002988:00000304");
    kernel.add_hid("hidraw8", "0003:0000046D:0000C077");
    EXPECT_EQ(shown_devices_of(0x2988, kernel.places()).size(), 2u);
    EXPECT_EQ(forbidden_of(look_for_omnis(kernel.places())), nullptr);
    EXPECT_EQ(forbidden_of(look_for_dhds(kernel.places())), nullptr);
    kernel.shut(kernel.places().usb_files / "001" / "004");
    kernel.shut(kernel.places().hidraw_files / "hidraw7");
    const AsNobody user;
    const auto omnis = look_for_omnis(kernel.places()), dhds = look_for_dhds(kernel.places());
    const DevicePresence *omni = forbidden_of(omnis), *dhd = forbidden_of(dhds);
    ASSERT_TRUE(omni != nullptr && dhd != nullptr);
    EXPECT_TRUE(omni->cause.contains("hidraw7 may not be opened by this user")) << omni->cause;
    EXPECT_TRUE(dhd->cause.contains("bus/001/004 may not be opened by this user")) << dhd->cause;
    for (const DevicePresence* one : {omni, dhd}) EXPECT_TRUE(one->remedy.contains(kUdevRules)) << one->remedy;
}

}  // namespace burin::devices
