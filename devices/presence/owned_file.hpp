// SPDX-License-Identifier: MIT
// Files of drivers, closed when they go out of scope, and how a thread that waits for them is told to end. Any thread.
#pragma once

#include <utility>

namespace burin::devices {

// Owns a file descriptor; -1: none.
class OwnedFile {
public:
    explicit OwnedFile(int file = -1) : file_(file) {}
    ~OwnedFile();
    OwnedFile(OwnedFile&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    OwnedFile& operator=(OwnedFile&& other) noexcept {
        std::swap(file_, other.file_);
        return *this;
    }
    [[nodiscard]] int get() const { return file_; }
    // Gives the file away: who takes it closes it.
    [[nodiscard]] int release() { return std::exchange(file_, -1); }
    [[nodiscard]] explicit operator bool() const { return file_ >= 0; }

private:
    int file_;
};

// Lets a thread that waits for sockets be told to end.
class StopSign {
public:
    StopSign();
    void give() const;
    [[nodiscard]] int file() const { return file_.get(); }
    // Waits until the file can be read, the sign is given or the time is over; -1: for the sign alone.
    enum class Woken { by_file, by_sign, by_time };
    [[nodiscard]] Woken wait_for(int file, int most_ms) const;

private:
    OwnedFile file_;
};

}  // namespace burin::devices
