// SPDX-License-Identifier: MIT
// A file system of SQLite's that is full, slow or broken when the test says so; else it passes everything on to the
// usual one. Set WriterOptions::vfs to its name. One of it in a program; its settings may change at any time, on any
// thread.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>

namespace burin::record::test {

struct FailingDisk {
    static constexpr const char* kName = "burin-failing-disk";

    std::atomic<bool> is_full{false};        // writes that make a file longer fail: no space
    std::atomic<bool> does_not_sync{false};  // flushes fail
    std::atomic<int> writes{0}, syncs{0};

    // Called before each flush, on the writer's thread.
    void set_before_sync(std::function<void()> call);
    void before_sync();
    // As new.
    void reset();

private:
    std::mutex mutex_;
    std::function<void()> before_sync_;
};

// Returns the one disk, registered with SQLite at the first call.
FailingDisk& failing_disk();

}  // namespace burin::record::test
