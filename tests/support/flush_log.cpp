// SPDX-License-Identifier: MIT
#include "tests/support/flush_log.hpp"

#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

namespace burin {
namespace {

namespace fs = std::filesystem;

struct FlushLog {
    std::mutex mutex;
    std::vector<Flushed> all;  // guarded by it
};

FlushLog& flush_log() {
    static FlushLog log;
    return log;
}

void note_flush(int fd) {
    std::error_code ignored;
    Flushed flushed{.path = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), ignored).string()};
    struct stat what{};
    flushed.is_folder = ::fstat(fd, &what) == 0 && S_ISDIR(what.st_mode);
    if (flushed.is_folder)
        for (fs::directory_iterator at(flushed.path, ignored), end; at != end; at.increment(ignored))
            flushed.names.push_back(at->path().filename().string());
    std::ranges::sort(flushed.names);
    FlushLog& log = flush_log();
    const std::lock_guard lock(log.mutex);
    log.all.push_back(std::move(flushed));
}

}  // namespace

void forget_flushes() {
    FlushLog& log = flush_log();
    const std::lock_guard lock(log.mutex);
    log.all.clear();
}

std::vector<Flushed> all_flushes() {
    FlushLog& log = flush_log();
    const std::lock_guard lock(log.mutex);
    return log.all;
}

}  // namespace burin

extern "C" int fsync(int fd) {
    burin::note_flush(fd);
    return static_cast<int>(::syscall(SYS_fsync, fd));
}

extern "C" int fdatasync(int fd) {
    burin::note_flush(fd);
    return static_cast<int>(::syscall(SYS_fdatasync, fd));
}
