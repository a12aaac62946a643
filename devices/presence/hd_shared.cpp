// SPDX-License-Identifier: MIT
#include "devices/presence/hd_shared.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

namespace burin::devices {
namespace {

std::string prefix() { return "burin-hd-" + std::to_string(::getuid()) + "-"; }
std::string path_of(const std::string& name) { return "/" + prefix() + name; }

// A name that a file may have.
bool is_name(std::string_view name) {
    return !name.empty() && name.size() < 100 && name.find('/') == std::string_view::npos;
}

HdShared* mapped(int file) {
    void* const at = ::mmap(nullptr, sizeof(HdShared), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    return at == MAP_FAILED ? nullptr : static_cast<HdShared*>(at);
}

}  // namespace

std::optional<HdSharedMemory> HdSharedMemory::create(const std::string& name) {
    MonotonicClock clock;
    if (!is_name(name)) return std::nullopt;
    if (const auto other = open(name); other && (*other)->is_alive(clock.now_ns())) return std::nullopt;
    ::shm_unlink(path_of(name).c_str());  // left behind by one that was killed
    const int file = ::shm_open(path_of(name).c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return std::nullopt;
    HdShared* const shared = ::ftruncate(file, sizeof(HdShared)) == 0 ? mapped(file) : nullptr;
    ::close(file);
    if (shared == nullptr) {
        ::shm_unlink(path_of(name).c_str());
        return std::nullopt;
    }
    new (shared) HdShared();
    return HdSharedMemory(shared, path_of(name));
}

std::optional<HdSharedMemory> HdSharedMemory::open(const std::string& name) {
    if (!is_name(name)) return std::nullopt;
    const int file = ::shm_open(path_of(name).c_str(), O_RDWR | O_CLOEXEC, 0600);
    if (file < 0) return std::nullopt;
    struct stat found{};
    const bool is_whole = ::fstat(file, &found) == 0 && found.st_size == static_cast<off_t>(sizeof(HdShared)) &&
                          found.st_uid == ::getuid();
    HdShared* const shared = is_whole ? mapped(file) : nullptr;
    ::close(file);
    if (shared == nullptr) return std::nullopt;
    return HdSharedMemory(shared, {});
}

HdSharedMemory::HdSharedMemory(HdSharedMemory&& other) noexcept
    : shared_(std::exchange(other.shared_, nullptr)), owned_(std::exchange(other.owned_, {})) {}

HdSharedMemory::~HdSharedMemory() {
    if (shared_ == nullptr) return;
    ::munmap(shared_, sizeof(HdShared));
    if (!owned_.empty()) ::shm_unlink(owned_.c_str());
}

std::vector<std::string> emulated_omnis() {
    std::vector<std::string> names;
    MonotonicClock clock;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/dev/shm", ignored)) {
        const std::string file = entry.path().filename().string();
        if (!file.starts_with(prefix())) continue;
        const std::string name = file.substr(prefix().size());
        if (const auto shared = HdSharedMemory::open(name); shared && (*shared)->is_alive(clock.now_ns()))
            names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace burin::devices
