// SPDX-License-Identifier: MIT
// Files as the fuzzers of file readers give them: the input itself, or a sound file with some bytes changed.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace burin::fuzz {

inline void require(bool condition) {
    if (!condition) std::abort();
}

// Returns the path of the one file in memory, which every call fills anew.
inline const std::string& file_with(const std::uint8_t* data, std::size_t size) {
    static const int fd = memfd_create("fuzz", 0);
    static const std::string path = "/proc/self/fd/" + std::to_string(fd);
    require(fd >= 0 && ftruncate(fd, 0) == 0);
    require(pwrite(fd, data, size, 0) == static_cast<ssize_t>(size));
    return path;
}

// Returns the path of a file of this process that a fuzzer makes and takes away again.
inline std::string own_path(const std::string& ending = {}) {
    return std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()) + ending);
}

// Returns the file's bytes, and removes it.
inline std::vector<std::uint8_t> take_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    std::filesystem::remove(path);
    return {bytes.begin(), bytes.end()};
}

// Returns a sound file with a byte changed for each four bytes of the input: three say where, one how.
inline const std::string& changed_file(const std::vector<std::uint8_t>& sound, const std::uint8_t* data,
                                       std::size_t size) {
    std::vector<std::uint8_t> changed = sound;
    for (std::size_t i = 0; i + 4 <= size; i += 4) {
        const std::size_t at = data[i] + 256u * data[i + 1] + 65536u * data[i + 2];
        changed[at % changed.size()] ^= data[i + 3];
    }
    return file_with(changed.data(), changed.size());
}

}  // namespace burin::fuzz
