// SPDX-License-Identifier: MIT
// Reads VRML 2.0 (VRML97, ISO/IEC 14772-1:1997) into a syntax tree: every node, field and value with its place in the
// text, PROTO definitions beside the nodes, DEF and USE resolved, and the files that Inline nodes name.
// vrml_shapes.hpp makes triangles of the tree.
//
// The syntax needs no table of node types: the value of a field ends where the next word cannot belong to it. Node and
// field names are checked later, and only of the nodes that have a shape, so that a world with nodes that Burin does
// not know is read all the same.
//
// Faults: reading goes on behind a fault, so that a file's faults are listed together (kMostVrmlFaults at most). Each
// has a file, a line and a column, and a remedy.
// Memory: a small multiple of the text (24 bytes for a field, 8 for a number), never what a number in it claims.
// Recursion: kDeepestVrmlNode levels at most. Threads: any; nothing shared. Cost: linear in the text.
//
// Why not Coin, the library that other programs read VRML with: Coin 4.0 crashes on a PROTO that names itself, on a USE
// inside its own DEF, on a cyclic Inline and on 20,000 nested groups; takes for ever on 29 doubling USEs and on an
// index of 10^8; reads wrong indices out of bounds; opens any path of the disk for an Inline; and loses a file for a
// single node that it does not know. The tests use it as the independent reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace burin::geometry {

inline constexpr std::size_t kMostVrmlBytes = std::size_t{1} << 28;  // of a file and all that it inlines
inline constexpr std::size_t kMostVrmlNodes = 1'000'000;             // in the text, and after expansion
inline constexpr std::size_t kMostVrmlInlines = 1000;                // different files
inline constexpr std::size_t kDeepestVrmlNode = 200;                 // nodes within nodes, and instances within them
inline constexpr std::size_t kMostVrmlFields = 1000;                 // of one node or PROTO
inline constexpr std::size_t kMostVrmlFaults = 200;                  // listed; reading stops behind them

// A place in one of the files: a byte of its text.
struct VrmlPlace {
    std::uint32_t file = 0;  // index into VrmlFile::sources
    std::uint32_t at = 0;    // byte of the text

    auto operator<=>(const VrmlPlace&) const = default;
};

struct VrmlFault {
    VrmlPlace place;
    std::string what, remedy;

    auto operator<=>(const VrmlFault&) const = default;
};

// Which arena of VrmlFile holds a field's values.
enum class VrmlKind : std::uint8_t {
    nothing,   // a field that declares no value, such as an event
    empty,     // a list without entries
    numbers,   // VrmlFile::numbers
    booleans,  // VrmlFile::numbers, 0 or 1
    strings,   // VrmlFile::strings
    nodes,     // VrmlFile::links; none for NULL
    is,        // one entry of VrmlFile::strings: the name of the PROTO's field
    broken,    // a fault stands in the list; nothing more is to be said about it
};

struct VrmlField {
    std::uint32_t at = 0, name_length = 0;  // the name, as bytes of the text
    std::uint32_t value_at = 0;
    std::uint32_t first = 0, count = 0;  // of its values, in the kind's arena
    VrmlKind kind = VrmlKind::nothing;
};

// A node as a value: where it stands, or where USE names it.
struct VrmlLink {
    std::uint32_t node = 0;  // index into VrmlFile::nodes
    std::uint32_t at = 0;    // byte of the text of the file that holds the field
};

inline constexpr std::uint32_t kNoVrmlIndex = ~std::uint32_t{0};

struct VrmlNode {
    std::uint32_t file = 0;
    std::uint32_t at = 0, type_length = 0;           // the type's name
    std::uint32_t name_at = 0, name_length = 0;      // given by DEF; no name: length 0
    std::uint32_t first_field = 0, field_count = 0;  // in VrmlFile::fields
    std::uint32_t prototype = kNoVrmlIndex;          // of which this is an instance
    std::uint32_t inlined = kNoVrmlIndex;            // of an Inline: index into VrmlFile::sources
    bool bound = false;                              // depends on the PROTO that it stands in (IS)
};

// The file that a list of names opens where an Inline in a PROTO takes it for its url.
struct VrmlBoundInline {
    std::uint32_t field = 0;              // the list, in VrmlFile::fields
    std::uint32_t source = kNoVrmlIndex;  // index into VrmlFile::sources; none: it cannot be opened
    VrmlFault fault;                      // why not
};

// A PROTO or EXTERNPROTO.
struct VrmlPrototype {
    std::uint32_t file = 0;
    std::uint32_t at = 0, name_length = 0;
    std::uint32_t first_field = 0, field_count = 0;  // the interface with its defaults, in VrmlFile::fields
    std::uint32_t first_link = 0, link_count = 0;    // the nodes of its body, in VrmlFile::links; the first one counts
    bool external = false;                           // EXTERNPROTO whose body was not found
    std::uint32_t url = kNoVrmlIndex;                // of an EXTERNPROTO: where that is, in VrmlFile::fields
};

// Returns the bytes of a file that an Inline, an EXTERNPROTO or a texture names. The name is relative to the root, has
// no "..", and is free of "." and "//".
using VrmlOpener = std::function<Result<std::string>(const std::string& name)>;

struct VrmlSource {
    std::string name;                              // as messages show it
    std::string below;                             // relative to the root
    std::unique_ptr<const std::string> text;       // without byte-order mark; line ends as they are
    std::vector<std::uint32_t> line_starts;        // bytes
    std::uint32_t first_root = 0, root_count = 0;  // top-level nodes, in VrmlFile::links
};

struct VrmlFile {
    VrmlOpener opener;                // of the pictures that textures name; none: there are no files
    std::filesystem::path root;       // of all names
    std::vector<VrmlSource> sources;  // the file itself, then the inlined ones
    std::vector<VrmlNode> nodes;
    std::vector<VrmlField> fields;
    std::vector<VrmlLink> links;
    std::vector<double> numbers;
    std::vector<std::string_view> strings;  // of the texts, without quotes; string_of() removes the backslashes
    std::vector<VrmlPrototype> prototypes;
    std::vector<VrmlBoundInline> bound_inlines;  // by field
    std::vector<VrmlFault> faults;               // of the syntax, in the order in which they were found
    std::vector<VrmlFault> remarks;              // likewise: what was read otherwise than it stands there, or left out

    [[nodiscard]] std::string_view text_at(VrmlPlace place, std::uint32_t length) const {
        return std::string_view(*sources[place.file].text).substr(place.at, length);
    }
    [[nodiscard]] std::string_view type_of(const VrmlNode& node) const {
        return text_at({node.file, node.at}, node.type_length);
    }
    [[nodiscard]] std::string_view name_of(const VrmlNode& node) const {
        return text_at({node.file, node.name_at}, node.name_length);
    }
    [[nodiscard]] std::string_view name_of(const VrmlPrototype& p) const {
        return text_at({p.file, p.at}, p.name_length);
    }
    [[nodiscard]] std::span<const VrmlField> fields_of(const VrmlNode& node) const {
        return std::span(fields).subspan(node.first_field, node.field_count);
    }
    [[nodiscard]] std::span<const VrmlField> fields_of(const VrmlPrototype& p) const {
        return std::span(fields).subspan(p.first_field, p.field_count);
    }
    [[nodiscard]] std::span<const VrmlLink> roots_of(const VrmlSource& source) const {
        return std::span(links).subspan(source.first_root, source.root_count);
    }

    // Returns what a list of names opens for an Inline; null where no Inline can take it.
    [[nodiscard]] const VrmlBoundInline* bound_inline(const VrmlField& field) const;

    // Returns "file:line:column". Lines end with LF, CR LF or CR; lines and columns count from 1, columns in
    // characters.
    [[nodiscard]] std::string where(VrmlPlace place) const;
    [[nodiscard]] Error error_of(const VrmlFault& fault) const {
        return {fault.what, where(fault.place), fault.remedy};
    }
    // Returns where the value number `index` of a field of that file stands. Cost: that of reading the field again.
    [[nodiscard]] VrmlPlace place_of_value(std::uint32_t file, const VrmlField& field, std::size_t index) const;
};

// Returns an opener of files in a folder, the root, and below it: that of a world's file, unless another is given. A
// name that leads out of it through a symbolic link is refused.
[[nodiscard]] VrmlOpener vrml_files_beside(const std::filesystem::path& world);
[[nodiscard]] VrmlOpener vrml_files_below(const std::filesystem::path& root);

// Reads the text of a world, packed with gzip or not. `name` stands for the file in messages; it lies below `root`, or
// directly in the folder of files that it may name. Without an opener, each Inline is a fault.
// Text that is not UTF-8 is read as Latin-1. Fails where nothing can be read: another format (VRML 1.0, X3D), UTF-16,
// too many bytes. All other faults are listed in the tree.
[[nodiscard]] Result<VrmlFile> read_vrml(std::string bytes, const std::string& name, const VrmlOpener& opener = {},
                                         const std::filesystem::path& root = {});

// Reads a world's file, and those that it names: of its folder and below, or of the root and below, in which it lies.
[[nodiscard]] Result<VrmlFile> read_vrml_file(const std::filesystem::path& path,
                                              const std::filesystem::path& root = {});

// Returns a string's value: without the backslashes before quotes and backslashes.
[[nodiscard]] std::string unescaped_vrml(std::string_view raw);

}  // namespace burin::geometry
