// SPDX-License-Identifier: MIT
// A maker's library, loaded while the program runs, and its functions by name. It stays loaded, since such libraries
// have threads of their own. One thread.
#pragma once

#include <dlfcn.h>

#include <string>

namespace burin::devices {

class LoadedLibrary {
public:
    // A path, or a name that the system's loader finds.
    explicit LoadedLibrary(const std::string& library)
        : library_(::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
        if (library_ != nullptr) return;
        const char* const why = ::dlerror();
        why_ = why != nullptr ? why : "no reason";
    }
    [[nodiscard]] bool is_there() const { return library_ != nullptr; }
    [[nodiscard]] const std::string& why() const { return why_; }  // it is not there

    // Finds a function; the first that is missing is noted.
    template <typename Function>
    void find(const char* name, Function*& to) {
        find_if_there(name, to);
        if (to == nullptr && missing_.empty()) missing_ = name;
    }
    template <typename Function>
    void find_if_there(const char* name, Function*& to) const {
        // POSIX: what dlsym returns can be taken for a function.
        to = reinterpret_cast<Function*>(::dlsym(library_, name));
    }
    [[nodiscard]] const std::string& missing() const { return missing_; }  // empty: none

private:
    void* library_;
    std::string why_, missing_;
};

}  // namespace burin::devices
