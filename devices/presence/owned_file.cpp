// SPDX-License-Identifier: MIT
#include "devices/presence/owned_file.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

namespace burin::devices {

OwnedFile::~OwnedFile() {
    if (file_ >= 0) ::close(file_);
}

StopSign::StopSign() : file_(::eventfd(0, EFD_CLOEXEC)) {}

void StopSign::give() const {
    const std::uint64_t one = 1;
    while (::write(file_.get(), &one, sizeof(one)) < 0 && errno == EINTR) {
    }
}

StopSign::Woken StopSign::wait_for(int file, int most_ms) const {
    std::array<pollfd, 2> ready{{{file_.get(), POLLIN, 0}, {file, POLLIN, 0}}};  // poll skips a negative file
    const int came = ::poll(ready.data(), ready.size(), most_ms);
    if (came > 0 && ready[0].revents != 0) return Woken::by_sign;
    if (came > 0 && ready[1].revents != 0) return Woken::by_file;
    return Woken::by_time;
}

}  // namespace burin::devices
