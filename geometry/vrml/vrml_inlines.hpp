// SPDX-License-Identifier: MIT
// Finds out which texts of a file an Inline may name through a PROTO: `url IS parts` takes what each instance gives for
// `parts`, or the PROTO's own default. Internal to geometry/vrml/.
//
// A text flows from a field of an instance, or from a PROTO's default, through any number of PROTOs within each other,
// to an Inline. Since a PROTO is known in its own file alone, so are all its instances. Pure; cost linear in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geometry/vrml/vrml_file.hpp"

namespace burin::geometry {

// The part of a tree that one of its files has made.
struct VrmlFilePart {
    std::uint32_t first_node = 0, end_node = 0;
    std::uint32_t first_prototype = 0, end_prototype = 0;
};

// Returns the fields of texts that can become the url of an Inline in a PROTO, as indices into VrmlFile::fields.
[[nodiscard]] std::vector<std::uint32_t> bound_inline_urls(const VrmlFile& file, const VrmlFilePart& part);

// Returns the name, relative to the root, of a file that an Inline, an EXTERNPROTO or a texture (`who`) names, or what
// is wrong with it. `folder` is that of the file in which the name stands, likewise relative.
[[nodiscard]] Result<std::string> named_vrml_file(const std::string& who, std::string_view raw,
                                                  const std::filesystem::path& folder);

// Returns a name with each %20 or other two hexadecimal digits behind a % as the byte that they stand for.
[[nodiscard]] std::string percent_decoded(std::string_view url);

}  // namespace burin::geometry
