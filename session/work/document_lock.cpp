// SPDX-License-Identifier: MIT
#include "session/work/document_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <span>
#include <sstream>
#include <utility>

#include "base/sha256.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

std::string note_of(const std::string& folder, const std::string& document) {
    std::error_code failed;
    const fs::path whole = fs::weakly_canonical(fs::absolute(document, failed), failed);
    return (fs::path(folder) / "open" / sha256(failed ? document : whole.string()).substr(0, 32)).string();
}

// Local time to the minute.
std::string now() {
    const std::time_t at = std::time(nullptr);
    std::tm parts{};
    std::array<char, 32> text{};
    if (::localtime_r(&at, &parts) == nullptr) return "?";
    return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &parts)};
}

std::string own_note() {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
    return std::to_string(::getpid()) + "\n" + host.data() + "\n" + now() + "\n";
}

DocumentHolder holder_in(int file) {
    std::array<char, 512> bytes{};
    const ssize_t got = ::pread(file, bytes.data(), bytes.size(), 0);
    std::istringstream lines(std::string(bytes.data(), got > 0 ? static_cast<std::size_t>(got) : 0));
    DocumentHolder holder;
    for (std::string* const line : {&holder.process, &holder.host, &holder.since})
        if (!std::getline(lines, *line) || line->empty()) *line = "?";
    return holder;
}

// Whether the open file is still the one of this path: its holder removes it at the end.
bool is_still(int file, const std::string& path) {
    struct stat opened{}, named{};
    return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
           opened.st_dev == named.st_dev;
}

}  // namespace

DocumentLock::DocumentLock(DocumentLock&& other) noexcept
    : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)) {}

DocumentLock& DocumentLock::operator=(DocumentLock&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(path_, other.path_);
    return *this;
}

DocumentLock::~DocumentLock() { release(); }

void DocumentLock::release() {
    if (file_ < 0) return;
    ::unlink(path_.c_str());  // before the lock goes, so that nobody takes a file that then disappears
    ::close(file_);
    file_ = -1;
}

std::optional<DocumentHolder> DocumentLock::take(const std::string& folder, const std::string& document) {
    if (folder.empty()) return std::nullopt;
    const std::string path = note_of(folder, document);
    if (file_ >= 0 && path == path_) return std::nullopt;
    release();
    std::error_code ignored;
    fs::create_directories(fs::path(path).parent_path(), ignored);
    constexpr int kTries = 10;
    for (int i = 0; i < kTries; ++i) {
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (file < 0) return std::nullopt;
        if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
            const DocumentHolder holder = holder_in(file);
            ::close(file);
            return holder;
        }
        if (!is_still(file, path)) {
            ::close(file);
            continue;
        }
        const std::string note = own_note();
        const bool written = ::ftruncate(file, 0) == 0 && ::pwrite(file, note.data(), note.size(), 0) > 0;
        static_cast<void>(written);  // a full disk: the lock holds all the same
        file_ = file;
        path_ = path;
        return std::nullopt;
    }
    return std::nullopt;
}

std::string text_of(const DocumentHolder& holder) {
    return "process " + holder.process + " on " + holder.host + " since " + holder.since;
}

}  // namespace burin::session
