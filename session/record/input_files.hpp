// SPDX-License-Identifier: MIT
// All files that a command or a session reads, also those that its files name: no output may overwrite one. A file that
// is not there yet counts as well. Threads: any. Cost: that of reading the texts of worlds, scripts and OBJ meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace burin::session {

struct SessionSetup;  // session/options/session_setup.hpp

// A list that grows; an empty path adds nothing.
class InputFiles {
public:
    InputFiles& file(const std::string& path);    // that names no other
    InputFiles& mesh(const std::string& path);    // with the material files of an OBJ
    InputFiles& world(const std::string& path);   // with all that it reads (scene/world_inputs.hpp)
    InputFiles& tool(const std::string& tool);    // the file of "mesh:FILE"
    InputFiles& device(const std::string& name);  // the description of "NAME:FILE"
    InputFiles& script(const std::string& path);  // with the tools that its commands take up

    [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

private:
    std::vector<std::string> list_;
};

// Returns all that the options name, the recording included: it is no input, and yet no place for another output.
[[nodiscard]] InputFiles inputs_of(const SessionSetup& options);

// Returns whether two names are of one file, by whatever path, whether it is there or not.
[[nodiscard]] bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace burin::session
