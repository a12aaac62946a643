// SPDX-License-Identifier: MIT
#include "tests/record/failing_disk.hpp"

#include <sqlite3.h>

#include <cstring>
#include <new>

namespace burin::record::test {
namespace {

// What SQLite allocates for a file: this, and behind it the usual file system's own.
struct ShimFile {
    sqlite3_file base;
    sqlite3_file* real;
};

sqlite3_file* real_of(sqlite3_file* file) { return reinterpret_cast<ShimFile*>(file)->real; }

int shim_close(sqlite3_file* f) { return real_of(f)->pMethods->xClose(real_of(f)); }
int shim_read(sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
    return real_of(f)->pMethods->xRead(real_of(f), to, n, at);
}
int shim_write(sqlite3_file* f, const void* from, int n, sqlite3_int64 at) {
    FailingDisk& disk = failing_disk();
    ++disk.writes;
    sqlite3_int64 size = 0;
    real_of(f)->pMethods->xFileSize(real_of(f), &size);
    if (disk.is_full && at + n > size) return SQLITE_FULL;
    return real_of(f)->pMethods->xWrite(real_of(f), from, n, at);
}
int shim_truncate(sqlite3_file* f, sqlite3_int64 size) { return real_of(f)->pMethods->xTruncate(real_of(f), size); }
int shim_sync(sqlite3_file* f, int flags) {
    FailingDisk& disk = failing_disk();
    ++disk.syncs;
    disk.before_sync();
    if (disk.does_not_sync) return SQLITE_IOERR_FSYNC;
    return real_of(f)->pMethods->xSync(real_of(f), flags);
}
int shim_size(sqlite3_file* f, sqlite3_int64* size) { return real_of(f)->pMethods->xFileSize(real_of(f), size); }
int shim_lock(sqlite3_file* f, int level) { return real_of(f)->pMethods->xLock(real_of(f), level); }
int shim_unlock(sqlite3_file* f, int level) { return real_of(f)->pMethods->xUnlock(real_of(f), level); }
int shim_reserved(sqlite3_file* f, int* out) { return real_of(f)->pMethods->xCheckReservedLock(real_of(f), out); }
int shim_control(sqlite3_file* f, int what, void* with) {
    return real_of(f)->pMethods->xFileControl(real_of(f), what, with);
}
int shim_sector(sqlite3_file* f) { return real_of(f)->pMethods->xSectorSize(real_of(f)); }
int shim_kind(sqlite3_file* f) { return real_of(f)->pMethods->xDeviceCharacteristics(real_of(f)); }

// Version 1: without shared memory, which a writer with an exclusive lock does not need.
const sqlite3_io_methods kShimMethods{1,         shim_close, shim_read,   shim_write,    shim_truncate, shim_sync,
                                      shim_size, shim_lock,  shim_unlock, shim_reserved, shim_control,  shim_sector,
                                      shim_kind, nullptr,    nullptr,     nullptr,       nullptr,       nullptr,
                                      nullptr};

int shim_open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
    auto* usual = static_cast<sqlite3_vfs*>(vfs->pAppData);
    auto* shim = reinterpret_cast<ShimFile*>(file);
    shim->real = reinterpret_cast<sqlite3_file*>(shim + 1);
    shim->base.pMethods = nullptr;
    const int code = usual->xOpen(usual, name, shim->real, flags, out_flags);
    if (code == SQLITE_OK) shim->base.pMethods = &kShimMethods;
    return code;
}

}  // namespace

void FailingDisk::set_before_sync(std::function<void()> call) {
    const std::lock_guard lock(mutex_);
    before_sync_ = std::move(call);
}

void FailingDisk::before_sync() {
    std::function<void()> call;
    {
        const std::lock_guard lock(mutex_);
        call = before_sync_;
    }
    if (call) call();
}

void FailingDisk::reset() {
    is_full = does_not_sync = false;
    writes = syncs = 0;
    set_before_sync({});
}

FailingDisk& failing_disk() {
    static FailingDisk disk;
    static sqlite3_vfs vfs;
    static const bool registered = [] {
        sqlite3_vfs* usual = sqlite3_vfs_find(nullptr);
        vfs = *usual;
        vfs.zName = FailingDisk::kName;
        vfs.szOsFile = static_cast<int>(sizeof(ShimFile)) + usual->szOsFile;
        vfs.pAppData = usual;
        vfs.xOpen = shim_open;
        sqlite3_vfs_register(&vfs, 0);
        return true;
    }();
    static_cast<void>(registered);
    return disk;
}

}  // namespace burin::record::test
