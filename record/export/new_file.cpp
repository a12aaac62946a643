// SPDX-License-Identifier: MIT
#include "record/export/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/file_io.hpp"
#include "base/flush_folder.hpp"
#include "base/try.hpp"

namespace burin::record {
namespace {

constexpr std::size_t kWriteBytes = 1 << 18;

// Returns 0, or the error number.
int write_whole(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

}  // namespace

Result<void> check_no_file(const std::string& path) {
    struct stat there{};
    if (path == "-" || ::lstat(path.c_str(), &there) != 0) return {};
    return fail(path, "exists, and is not written over", "choose another name, or take it away first");
}

Result<NewFile> NewFile::create(const std::string& path) {
    NewFile file;
    file.path_ = path;
    if (path == "-") {
        file.fd_ = STDOUT_FILENO;
        return file;
    }
    BURIN_TRY_DO(check_writable(path));
    const std::string temporary = path + "." + std::to_string(::getpid()) + ".part";
    file.fd_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.fd_ < 0) return file.failed(errno);
    file.temporary_ = temporary;
    return file;
}

NewFile::NewFile(NewFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      waiting_(std::move(other.waiting_)),
      fd_(std::exchange(other.fd_, -1)) {}

NewFile::~NewFile() {
    if (temporary_.empty()) return;
    if (fd_ >= 0) ::close(fd_);
    ::unlink(temporary_.c_str());
}

std::unexpected<Error> NewFile::failed(int code) const {
    return fail(path_, "cannot be written: " + std::generic_category().message(code),
                code == ENOSPC || code == EDQUOT ? "free some space or choose another disk" : "choose another folder");
}

Result<void> NewFile::write(std::string_view bytes) {
    waiting_ += bytes;
    return waiting_.size() < kWriteBytes ? Result<void>() : flush();
}

Result<void> NewFile::flush() {
    const int code = write_whole(fd_, waiting_);
    waiting_.clear();
    if (code != 0) return failed(code);
    return {};
}

Result<void> NewFile::write_at(std::size_t offset, std::string_view bytes) {
    BURIN_TRY_DO(flush());
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return failed(errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
        offset += static_cast<std::size_t>(written);
    }
    return {};
}

Result<void> NewFile::finish() {
    BURIN_TRY_DO(flush());
    if (is_standard_output()) return {};
    if (::fsync(fd_) != 0) return failed(errno);
    if (::close(std::exchange(fd_, -1)) != 0) return failed(errno);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) return failed(errno);
    temporary_.clear();
    flush_folder_of(path_);
    return {};
}

}  // namespace burin::record
