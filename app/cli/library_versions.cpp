// SPDX-License-Identifier: MIT
#include "app/cli/library_versions.hpp"

#include <dlfcn.h>

#include <utility>

#include "base/text.hpp"

namespace burin::app {
namespace {

// Returns a function of a library that the program has loaded, by its name in that library's manual; null: there is
// none. So no header of seven libraries is needed, nor a link to one that this build does without.
template <typename Function>
Function* of_library(const char* symbol) {
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, symbol));
}

struct UsbVersion {  // as libusb_version of libusb 1.0, its first members
    unsigned short major, minor, micro;
};

// Adds versions that a function returns as a text. It takes nothing, or a pointer that it ignores.
void add_texts(std::vector<LibraryVersion>& to) {
    for (const auto& [name, symbol] :
         {std::pair("GLFW", "glfwGetVersionString"), std::pair("SQLite", "sqlite3_libversion"),
          std::pair("oneTBB", "TBB_runtime_version"), std::pair("zstd", "ZSTD_versionString"),
          std::pair("libpng", "png_get_libpng_ver")})
        if (auto* const version = of_library<const char*(const void*)>(symbol)) to.push_back({name, version(nullptr)});
}

}  // namespace

std::vector<LibraryVersion> library_versions() {
    std::vector<LibraryVersion> all;
    add_texts(all);
    if (auto* const version = of_library<int(unsigned*, unsigned*, unsigned*)>("H5get_libversion")) {
        unsigned major = 0, minor = 0, release = 0;
        if (version(&major, &minor, &release) >= 0)
            all.push_back({"HDF5", formatted("%u.%u.%u", major, minor, release)});
    }
    if (auto* const version = of_library<const UsbVersion*()>("libusb_get_version")) {
        const UsbVersion& is = *version();
        all.push_back({"libusb", formatted("%u.%u.%u", is.major, is.minor, is.micro)});
    }
    if (auto* const version = of_library<int()>("FcGetVersion")) {
        const int is = version();  // 21401: 2.14.1
        all.push_back({"fontconfig", formatted("%d.%d.%d", is / 10000, is / 100 % 100, is % 100)});
    }
    return all;
}

}  // namespace burin::app
