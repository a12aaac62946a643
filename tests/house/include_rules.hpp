// SPDX-License-Identifier: MIT
// Finds includes that a file has forgotten, from texts alone. Where the sources of a room are compiled as one, a
// compiler does not notice them: a roommate has read the header already.
//
// What counts as forgotten: the file uses a name, a header of the tree declares it in a namespace, and none of the
// headers that the file reaches mentions it. Names are types, constants (kUpperCamel) and functions that are called.
// Names of the standard library have a table: one of the headers that the file reaches includes what declares the name.
// The rule is generous, so that what it reports is a fault: a name that any reached header mentions passes, also where
// that header only declares it forward or has something else of the name. Members are not looked at.
// How much of what a compiler finds it finds is measured in docs/decisions/016-build-time.md.
//
// Pure reading; one thread; a second for a tree of 1,500 files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace burin::house {

// One line for each ("study/a.cpp:7: uses Pose of base/space.hpp, which no header that it includes mentions"), sorted.
[[nodiscard]] std::vector<std::string> include_violations(const std::filesystem::path& root);

}  // namespace burin::house
