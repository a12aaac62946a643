// SPDX-License-Identifier: MIT
#include "devices/presence/shared_memory.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string_view>

namespace burin::devices {
namespace {

std::string start_of(const char* prefix) { return std::string(prefix) + std::to_string(::getuid()) + "-"; }
std::string path_of(const char* prefix, const std::string& name) { return "/" + start_of(prefix) + name; }

// A name that a file may have.
bool is_name(std::string_view name) {
    return !name.empty() && name.size() < 100 && name.find('/') == std::string_view::npos;
}

void* mapped(int file, std::size_t size) {
    void* const at = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    return at == MAP_FAILED ? nullptr : at;
}

}  // namespace

SharedBytes create_shared(const char* prefix, const std::string& name, std::size_t size) {
    if (!is_name(name)) return {};
    const std::string path = path_of(prefix, name);
    ::shm_unlink(path.c_str());  // left behind by one that was killed
    const int file = ::shm_open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return {};
    void* const at = ::ftruncate(file, static_cast<off_t>(size)) == 0 ? mapped(file, size) : nullptr;
    ::close(file);
    if (at == nullptr) {
        ::shm_unlink(path.c_str());
        return {};
    }
    return {at, path};
}

void* open_shared(const char* prefix, const std::string& name, std::size_t size) {
    if (!is_name(name)) return nullptr;
    const int file = ::shm_open(path_of(prefix, name).c_str(), O_RDWR | O_CLOEXEC, 0600);
    if (file < 0) return nullptr;
    struct stat found{};
    const bool is_whole =
        ::fstat(file, &found) == 0 && found.st_size == static_cast<off_t>(size) && found.st_uid == ::getuid();
    void* const at = is_whole ? mapped(file, size) : nullptr;
    ::close(file);
    return at;
}

void close_shared(const SharedBytes& bytes, std::size_t size) {
    if (bytes.at == nullptr) return;
    ::munmap(bytes.at, size);
    if (!bytes.owned.empty()) ::shm_unlink(bytes.owned.c_str());
}

bool take_ownership(std::atomic<std::uint32_t>& owner) noexcept {
    const auto own = static_cast<std::uint32_t>(::getpid());
    // acquire and release: what the last owner wrote is seen before the new one writes.
    std::uint32_t found = owner.load(std::memory_order_acquire);
    while (found == 0 || (::kill(static_cast<pid_t>(found), 0) != 0 && errno == ESRCH))
        if (owner.compare_exchange_weak(found, own, std::memory_order_acq_rel)) return true;
    return false;
}

std::vector<std::string> shared_names(const char* prefix) {
    std::vector<std::string> names;
    std::error_code ignored;
    const std::string start = start_of(prefix);
    for (std::filesystem::directory_iterator at("/dev/shm", ignored), end; !ignored && at != end;
         at.increment(ignored)) {
        const std::string file = at->path().filename().string();
        if (file.starts_with(start)) names.push_back(file.substr(start.size()));
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace burin::devices
