// SPDX-License-Identifier: MIT
// Rules on the structure of the sources, beside the layers between folders (layer_rules.hpp): rooms (folders that hold
// sources, subfolders included) have an order, and a name has one meaning in a namespace. Pure reading; one thread;
// cost is one pass over the sources.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace burin::house {

// One line for each group of rooms that include each other in a circle ("a -> b (a/x.hpp includes b/y.hpp), b -> a
// (...)"). Sources below tests/ are left aside: nobody includes them but tests.
[[nodiscard]] std::vector<std::string> room_cycles(const std::filesystem::path& root);

// A class, struct, union or enum that a text defines in a named namespace, with its enclosing types:
// "burin::gpu::Device". Types in anonymous namespaces and in functions are left aside: no other source can see them.
[[nodiscard]] std::vector<std::string> types_defined_in(const std::string& source);

// One line for each type that two files define ("burin::Room is defined in a.hpp and in b.hpp"), which is undefined
// behaviour as soon as both are linked into one program. Sources below tests/ are left aside: they belong to different
// programs.
[[nodiscard]] std::vector<std::string> types_defined_twice(const std::filesystem::path& root);

}  // namespace burin::house
