// SPDX-License-Identifier: MIT
// Makes a session's workpiece on a thread of its own, while the frame's thread shows what there is of it already
// (opening.hpp). Threads: all of it is for the frame's; OpeningSight is what both threads have of each other.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "picture/drawn_mesh.hpp"
#include "session/options/carve_options.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {

// The mesh of a file before its solid is there; a coarse copy where it is large.
struct FirstLook {
    std::shared_ptr<const picture::DrawnMesh> mesh;
    Box bounds_object;
};

// What the two threads have of each other.
class OpeningSight {
public:
    // A call of wake, on any thread, has the frame's thread look at once.
    explicit OpeningSight(std::function<void()> wake) : wake_(std::move(wake)) {}

    WorkWatch& work() { return work_; }
    void show(FirstLook look);
    [[nodiscard]] std::optional<FirstLook> take_look();
    void finish();  // the work is done, well or not
    [[nodiscard]] bool is_finished() const { return finished_.load(std::memory_order_acquire); }

    // Counts the pictures that have been shown meanwhile, and waits for so many, or until the work is not wanted any
    // more; returns whether they were shown.
    void shown();
    [[nodiscard]] unsigned pictures();
    [[nodiscard]] bool wait_for_pictures(unsigned count);
    void stop();  // ends the work, soon

private:
    WorkWatch work_;
    std::function<void()> wake_;
    std::mutex mutex_;
    std::condition_variable seen_;
    std::optional<FirstLook> look_;
    unsigned pictures_ = 0;
    std::atomic<bool> finished_{false};  // release: what was made is there
};

class OpeningWork {
public:
    using Make = std::function<Result<std::unique_ptr<workpiece::Workpiece>>(OpeningSight&)>;
    // Begins at once. The wake function must stay callable until the end.
    OpeningWork(Make make, std::function<void()> wake);
    ~OpeningWork();  // stops the work and waits for that
    OpeningWork(const OpeningWork&) = delete;
    OpeningWork& operator=(const OpeningWork&) = delete;

    [[nodiscard]] OpeningSight& sight() { return sight_; }
    // Waits for the work, and returns what it made; once.
    [[nodiscard]] Result<std::unique_ptr<workpiece::Workpiece>> take();

private:
    OpeningSight sight_;
    Result<std::unique_ptr<workpiece::Workpiece>> made_;
    std::jthread thread_;
};

// Makes the workpiece of these options, and gives the sight a first look at its mesh.
[[nodiscard]] Result<std::unique_ptr<workpiece::Workpiece>> make_in_sight(const CarveOptions& carve, unsigned threads,
                                                                          OpeningSight& sight);

}  // namespace burin::session
