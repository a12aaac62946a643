// SPDX-License-Identifier: MIT
#include "record/private_index.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace burin::record {
namespace {

constexpr const char* kPrivateIndexName = "burin-private-index";

// What lies behind the usual file system's own record of a file: the same methods but for those of the index.
struct PrivateIndex {
    sqlite3_io_methods methods;
    const sqlite3_io_methods* usual;
    std::vector<std::unique_ptr<std::byte[]>> regions;
};

std::size_t bytes_of_usual_file() {
    constexpr std::size_t kAlign = alignof(PrivateIndex);
    static const auto usual = static_cast<std::size_t>(sqlite3_vfs_find(nullptr)->szOsFile);
    return (usual + kAlign - 1) / kAlign * kAlign;
}

void* place_of_index(sqlite3_file* file) { return reinterpret_cast<std::byte*>(file) + bytes_of_usual_file(); }

PrivateIndex& index_of(sqlite3_file* file) { return *std::launder(static_cast<PrivateIndex*>(place_of_index(file))); }

int map_region(sqlite3_file* file, int number, int bytes, int may_extend, void volatile** region) {
    auto& regions = index_of(file).regions;
    const auto at = static_cast<std::size_t>(number);
    *region = nullptr;
    if (at >= regions.size() && may_extend == 0) return SQLITE_OK;
    while (regions.size() <= at) {
        // No exception may pass through SQLite. A new region is zero, as that of a new file.
        auto* const memory = new (std::nothrow) std::byte[static_cast<std::size_t>(bytes)]();
        if (memory == nullptr) return SQLITE_NOMEM;
        regions.emplace_back(memory);
    }
    *region = regions[at].get();
    return SQLITE_OK;
}

// Nobody else has this index, so that its locks are always free.
int lock_index(sqlite3_file*, int, int, int) { return SQLITE_OK; }

void order_index(sqlite3_file*) { std::atomic_thread_fence(std::memory_order_seq_cst); }

int unmap_index(sqlite3_file* file, int) {
    index_of(file).regions.clear();
    return SQLITE_OK;
}

int close_file(sqlite3_file* file) {
    PrivateIndex& index = index_of(file);
    const int code = index.usual->xClose(file);
    index.~PrivateIndex();
    return code;
}

int open_file(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
    auto* usual = static_cast<sqlite3_vfs*>(vfs->pAppData);
    const int code = usual->xOpen(usual, name, file, flags, out_flags);
    if (code != SQLITE_OK || (flags & SQLITE_OPEN_MAIN_DB) == 0) return code;
    auto* const index = new (place_of_index(file)) PrivateIndex{*file->pMethods, file->pMethods, {}};
    index->methods.xClose = close_file;
    index->methods.xShmMap = map_region;
    index->methods.xShmLock = lock_index;
    index->methods.xShmBarrier = order_index;
    index->methods.xShmUnmap = unmap_index;
    file->pMethods = &index->methods;
    return code;
}

}  // namespace

const char* private_index_vfs() {
    static sqlite3_vfs vfs = [] {
        sqlite3_vfs* const usual = sqlite3_vfs_find(nullptr);
        sqlite3_vfs made = *usual;
        made.zName = kPrivateIndexName;
        made.szOsFile = static_cast<int>(bytes_of_usual_file() + sizeof(PrivateIndex));
        made.pAppData = usual;
        made.xOpen = open_file;
        return made;
    }();
    static const bool is_registered = sqlite3_vfs_register(&vfs, 0) == SQLITE_OK;
    return is_registered ? kPrivateIndexName : nullptr;
}

// The byte that each connection locks for reading as long as it has the file open: sqlite.org/walformat.html, "WAL
// Locks".
bool is_index_shared(const std::string& path) {
    constexpr off_t kDeadManSwitch = 128;
    const int fd = ::open((path + "-shm").c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return false;
    struct flock lock{};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = kDeadManSwitch;
    lock.l_len = 1;
    const bool is_shared = ::fcntl(fd, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    ::close(fd);
    return is_shared;
}

}  // namespace burin::record
