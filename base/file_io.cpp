// SPDX-License-Identifier: MIT
#include "base/file_io.hpp"

#include "base/flush_folder.hpp"
#include "base/places.hpp"
#include "base/sha256.hpp"
#include "base/try.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace burin {
namespace {

namespace fs = std::filesystem;

// Closes the file at the end of a scope unless close() already did.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] bool valid() const { return fd_ >= 0; }
    [[nodiscard]] int number() const { return fd_; }
    [[nodiscard]] bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

private:
    int fd_;
};

std::string reason(int code) { return std::generic_category().message(code); }

const char* reading_remedy(int code) {
    switch (code) {
        case ENOENT:
        case ENOTDIR: return "check the path";
        case EACCES:
        case EPERM: return "make it readable (chmod u+r)";
        default: return "check that the file and its disk can be read";
    }
}

const char* writing_remedy(int code) {
    switch (code) {
        case ENOENT:
        case ENOTDIR: return "create the folder first";
        case EACCES:
        case EPERM:
        case EROFS: return "choose a folder that you may write to";
        case ENOSPC:
        case EDQUOT: return "free some space or choose another folder; the target was not touched";
        case EFBIG: return "choose another disk or a lower resolution; the target was not touched";
        case ENAMETOOLONG: return "choose a shorter name";
        case ELOOP: return "remove the symbolic link, which leads in a circle, or choose another name";
        default: return "choose another folder; the target was not touched";
    }
}

std::unexpected<Error> cannot_read(const fs::path& path, int code) {
    BURIN_TRY_DO(check_working_folder(path));
    return fail(path.string(), "cannot be read: " + reason(code), reading_remedy(code));
}

std::unexpected<Error> cannot_write(const fs::path& path, int code) {
    BURIN_TRY_DO(check_working_folder(path));
    return fail(path.string(), "cannot be written: " + reason(code), writing_remedy(code));
}

// Returns 0, or the error number.
int write_all(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        // The kernel writes at most 2 GiB at once.
        const std::size_t chunk = std::min(bytes.size(), std::size_t{1} << 30);
        const ssize_t written = ::write(fd, bytes.data(), chunk);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

struct Target {
    fs::path path;               // after following symbolic links
    std::optional<mode_t> mode;  // permissions to keep, when the file exists
};

Result<Target> examine_target(const fs::path& asked) {
    if (asked.filename().empty()) return fail(asked.string(), "is not a file name", "name a file, not a folder");
    Target target{asked, {}};
    std::error_code ignored;
    if (fs::is_symlink(asked, ignored)) {
        const fs::path followed = fs::weakly_canonical(asked, ignored);
        if (!ignored) target.path = followed;
    }
    struct stat info{};
    if (::stat(target.path.c_str(), &info) != 0) {
        if (errno == ENOENT) return target;
        return cannot_write(asked, errno);
    }
    if (S_ISDIR(info.st_mode)) return fail(asked.string(), "is a folder", "name a file inside it");
    if (!S_ISREG(info.st_mode)) return fail(asked.string(), "is not a regular file", "choose another name");
    if (::access(target.path.c_str(), W_OK) != 0) {
        return fail(asked.string(), "exists and is write-protected",
                    "choose another name or make it writable (chmod u+w)");
    }
    target.mode = info.st_mode & 07777;
    return target;
}

// Returns a name distinct for every call in every process, so that two writers never share a temporary file.
fs::path temporary_beside(const fs::path& target) {
    static std::atomic<unsigned> counter{0};  // only its uniqueness matters, hence relaxed
    const unsigned serial = counter.fetch_add(1, std::memory_order_relaxed);
    // Truncates the name, so that a target name near the file system's limit still has room for the suffix.
    const std::string stem = target.filename().string().substr(0, 120);
    return target.parent_path() /
           ("." + stem + "." + std::to_string(::getpid()) + "." + std::to_string(serial) + ".part");
}

int write_and_flush(const fs::path& path, const Target& target, std::span<const std::byte> bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.valid()) return errno;
    if (const int code = write_all(file.number(), bytes); code != 0) return code;
    if (target.mode && ::fchmod(file.number(), *target.mode) != 0) return errno;
    if (::fsync(file.number()) != 0) return errno;
    return file.close() ? 0 : errno;
}

// Reads a regular file into a container of bytes or characters.
template <typename Bytes>
Result<Bytes> read_whole(const fs::path& path, std::uint64_t max_bytes) {
    // O_NONBLOCK: opening a pipe that nobody writes must not block; it is refused just below.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.valid()) return cannot_read(path, errno);
    struct stat info{};
    if (::fstat(file.number(), &info) != 0) return cannot_read(path, errno);
    if (S_ISDIR(info.st_mode)) return fail(path.string(), "is a folder", "name a file inside it");
    if (!S_ISREG(info.st_mode))
        return fail(path.string(), "is not a regular file", "copy its content into a file first");
    const auto size = static_cast<std::uint64_t>(info.st_size);
    if (size > max_bytes) {
        return fail(path.string(),
                    "has " + std::to_string(size) + " bytes, more than the limit of " + std::to_string(max_bytes),
                    "reduce it first");
    }
    Bytes bytes;
    bytes.resize(static_cast<std::size_t>(size));
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t got = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return cannot_read(path, errno);
        if (got == 0) return fail(path.string(), "became shorter while it was read", "try again when nobody writes it");
        filled += static_cast<std::size_t>(got);
    }
    return bytes;
}

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

struct Encoding {
    const char* name;
    std::string_view mark;       // the byte-order mark
    std::array<bool, 4> zeroes;  // which of the first four bytes are zero where two letters of ASCII come first
};

// The longer marks come first: that of UTF-16 begins the one of UTF-32.
constexpr std::array<Encoding, 4> kForeignEncodings{{
    {"UTF-32", {"\xFF\xFE\0\0", 4}, {false, true, true, true}},
    {"UTF-32", {"\0\0\xFE\xFF", 4}, {true, true, true, false}},
    {"UTF-16", {"\xFF\xFE", 2}, {false, true, false, true}},
    {"UTF-16", {"\xFE\xFF", 2}, {true, false, true, false}},
}};

bool has_zeroes_of(std::string_view bytes, const Encoding& encoding) {
    if (bytes.size() < encoding.zeroes.size()) return false;
    for (std::size_t i = 0; i < encoding.zeroes.size(); ++i) {
        if ((bytes[i] == '\0') != encoding.zeroes[i]) return false;
    }
    return true;
}

// Makes every line end LF.
void unify_line_ends(std::string& text) {
    std::size_t kept = text.find('\r');
    if (kept == std::string::npos) return;
    for (std::size_t i = kept; i < text.size(); ++i) {
        const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!pair) text[kept++] = text[i] == '\r' ? '\n' : text[i];
    }
    text.resize(kept);
}

}  // namespace

Result<std::vector<std::byte>> read_file(const fs::path& path, std::uint64_t max_bytes) {
    return read_whole<std::vector<std::byte>>(path, max_bytes);
}

std::string_view without_byte_order_mark(std::string_view text) {
    return text.starts_with(kUtf8Mark) ? text.substr(kUtf8Mark.size()) : text;
}

Result<std::string_view> utf8_text(std::string_view bytes, const std::string& name) {
    for (const Encoding& encoding : kForeignEncodings) {
        if (bytes.starts_with(encoding.mark) || has_zeroes_of(bytes, encoding))
            return fail(name, std::string("is ") + encoding.name + " text", "save it as UTF-8");
    }
    return without_byte_order_mark(bytes);
}

Result<std::string> read_text_file(const fs::path& path, std::uint64_t max_bytes) {
    Result<std::string> bytes = read_whole<std::string>(path, max_bytes);
    if (!bytes) return bytes;
    BURIN_TRY(text, utf8_text(*bytes, path.string()));
    bytes->erase(0, bytes->size() - text.size());
    unify_line_ends(*bytes);
    return bytes;
}

Result<std::string> file_digest(const fs::path& path) {
    BURIN_TRY(bytes, read_file(path));
    return sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<void> check_writable(const fs::path& path) {
    BURIN_TRY_DO(check_working_folder(path));
    BURIN_TRY(target, examine_target(path));
    const fs::path parent = target.path.parent_path(), folder = parent.empty() ? "." : parent;
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) {
        return fail(path.string(), "cannot be written: there is no folder " + absolute_path(folder).string(),
                    "make the folder, or choose another place");
    }
    if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
    return fail(path.string(), "cannot be written: no permission in folder " + absolute_path(folder).string(),
                "choose another place");
}

Result<void> write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
    BURIN_TRY(target, examine_target(path));
    const fs::path temporary = temporary_beside(target.path);
    int code = write_and_flush(temporary, target, bytes);
    if (code == 0 && ::rename(temporary.c_str(), target.path.c_str()) != 0) code = errno;
    if (code != 0) {
        if (code != EEXIST) ::unlink(temporary.c_str());  // EEXIST: another writer's file
        return cannot_write(path, code);
    }
    flush_folder_of(target.path);
    return {};
}

}  // namespace burin
