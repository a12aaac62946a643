// SPDX-License-Identifier: MIT
// Reads STL. Binary: an 80-byte header, a 32-bit count, then 50 bytes a triangle (normal, three corners, attribute),
// little endian. ASCII: solid, facet normal, outer loop, vertex, endloop (or end loop), endfacet, endsolid; any case,
// any number of solids. A binary header may say "solid" too, so the file's size decides first. Normals are ignored: the
// winding gives them. Attributes may be colours, see StlColours. The header of a binary file, or the name of
// a solid, may state the unit: "UNITS=mm".
#include <algorithm>
#include <bit>
#include <cstring>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/files/unit_statement.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::geometry {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read as the machine's own floats");

constexpr std::size_t kTitleBytes = 80, kHeaderBytes = 84, kTriangleBytes = 50, kNormalBytes = 12;

std::uint64_t bytes_claimed(std::span<const std::byte> bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return kHeaderBytes + std::uint64_t{kTriangleBytes} * count;
}

// Tells whether the file is text: it says "solid" first and holds no zero byte near its start, whereas binary headers
// are padded with zeros or the count has one.
bool looks_like_text(std::string_view text) {
    TextScanner scan(text.substr(0, 512));
    return equals_ignoring_case(scan.token(), "solid") && text.substr(0, 512).find('\0') == std::string_view::npos;
}

// Whether nothing in its first kilobyte is other than letters, signs and spaces.
bool is_plain_text(std::string_view text) {
    return std::ranges::all_of(text.substr(0, 1024), [](char c) {
        return (static_cast<unsigned char>(c) >= 32 && c != 127) || c == '\n' || c == '\r' || c == '\t';
    });
}

// The colours that attributes of a binary file mean, 5 bits a channel. Materialise Magics writes COLOR= and four bytes
// (red, green, blue, alpha) for the whole into the header; a triangle whose highest bit is unset has a colour of its
// own, red in the lowest bits. VisCAM and SolidView write no such header; a triangle whose highest bit is set has a
// colour, blue in the lowest bits.
class StlColours {
public:
    StlColours(std::span<const std::byte> title, MeshSoup& soup) : soup_(soup) {
        constexpr std::string_view kWord = "COLOR=";
        const std::size_t at = text_of(title).find(kWord);
        if (at == std::string_view::npos || at + kWord.size() + 3 > title.size()) return;
        is_magics_ = true;
        for (std::size_t c = 0; c < 3; ++c) whole_[c] = std::to_integer<std::uint8_t>(title[at + kWord.size() + c]);
    }

    void see(std::uint16_t attribute) {
        if (attribute != 0) ++with_attribute_;
        if (has_own(attribute)) ++with_colour_;
        attributes_.push_back(attribute);
    }

    // Without any colour of its own an attribute is another program's number.
    void resolve() {
        if (is_magics_ || with_colour_ > 0) {
            ColourMaterials materials(soup_.materials);
            for (const std::uint16_t attribute : attributes_)
                soup_.face_materials.push_back(materials.index_of(has_own(attribute) ? own(attribute) : whole_));
        } else if (with_attribute_ > 0) {
            soup_.report.remarks.push_back("the attributes of " + std::to_string(with_attribute_) +
                                           " triangles were ignored: they are no colours that Burin knows");
        }
    }

private:
    static constexpr unsigned kFlag = 0x8000;

    [[nodiscard]] bool has_own(std::uint16_t attribute) const { return ((attribute & kFlag) == 0) == is_magics_; }
    [[nodiscard]] Colour own(std::uint16_t attribute) const {
        Colour colour{};
        for (std::size_t c = 0; c < 3; ++c) {
            const unsigned bits = attribute >> (5 * (is_magics_ ? c : 2 - c)) & 31u;
            colour[c] = static_cast<std::uint8_t>((bits * 255 + 15) / 31);
        }
        return colour;
    }

    MeshSoup& soup_;
    bool is_magics_ = false;
    Colour whole_ = kPlainColour;
    std::vector<std::uint16_t> attributes_;
    std::uint64_t with_attribute_ = 0, with_colour_ = 0;
};

Result<MeshSoup> read_binary(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() < kHeaderBytes) {
        return fail(name, "has " + std::to_string(bytes.size()) + " bytes, too few for an STL file", kTruncatedRemedy);
    }
    const std::uint64_t follow = (bytes.size() - kHeaderBytes) / kTriangleBytes;
    std::uint64_t claimed = bytes_claimed(bytes);
    std::uint64_t count = (claimed - kHeaderBytes) / kTriangleBytes;
    // A program that writes triangles as they come may leave such a count behind.
    const bool is_open = count == 0 && follow > 0;
    if (is_open && bytes.size() != kHeaderBytes + kTriangleBytes * follow)
        return fail(name,
                    "counts 0 triangles in its header, and the " + std::to_string(bytes.size() - kHeaderBytes) +
                        " bytes behind it are no whole number of them",
                    kTruncatedRemedy);
    if (is_open) claimed = bytes.size(), count = follow;
    if (claimed > bytes.size()) {
        if (is_plain_text(text_of(bytes)))
            return fail(name, "is a text, but no STL file: that begins with the word solid",
                        "give a mesh: .stl, .obj, .ply or .off");
        return fail(name,
                    "claims " + std::to_string(count) + " triangles (" + std::to_string(claimed) +
                        " bytes) but has only " + std::to_string(bytes.size()) + " bytes",
                    kTruncatedRemedy);
    }
    MeshSoup soup;
    soup.report.format = "STL, binary";
    if (is_open) {
        soup.report.remarks.push_back("its header counts 0 triangles, and " + std::to_string(follow) +
                                      " follow: all of them were read");
    }
    if (const auto unit = unit_in_header(text_of(bytes.first(kTitleBytes))))
        soup.stated_unit = {*unit, "in its header"};
    if (claimed < bytes.size()) {
        soup.report.remarks.push_back(std::to_string(bytes.size() - claimed) +
                                      " bytes after the last triangle were ignored");
    }
    VertexWeld weld(soup.positions);
    soup.corners.reserve(3 * count);
    soup.corner_counts.assign(count, 3);
    StlColours colours(bytes.first(kTitleBytes), soup);
    for (std::uint64_t t = 0; t < count; ++t) {
        const std::byte* triangle = bytes.data() + kHeaderBytes + t * kTriangleBytes;
        float xyz[9];
        std::memcpy(xyz, triangle + kNormalBytes, sizeof xyz);
        for (std::size_t k = 0; k < 9; ++k) {
            soup.precision.see(xyz[k]);
            const auto byte = kHeaderBytes + t * kTriangleBytes + kNormalBytes + 4 * k;
            if (is_far(xyz[k]) && soup.far.empty()) soup.far = at_byte(name, byte);
            if (const char* fault = coordinate_fault(xyz[k])) {
                return fail(at_byte(name, byte), fault, kCoordinateRemedy);
            }
        }
        for (std::size_t k = 0; k < 9; k += 3) soup.corners.push_back(weld.index_of({xyz[k], xyz[k + 1], xyz[k + 2]}));
        std::uint16_t attribute = 0;
        std::memcpy(&attribute, triangle + kNormalBytes + sizeof xyz, sizeof attribute);
        colours.see(attribute);
    }
    colours.resolve();
    soup.report.vertices_merged = soup.corners.size() - soup.positions.size();
    return soup;
}

class AsciiStl {
public:
    AsciiStl(std::string_view text, const std::string& name) : scan_(text), name_(name), weld_(soup_.positions) {}

    Result<MeshSoup> read() {
        soup_.report.format = "STL, ASCII";
        for (std::string_view word = scan_.token(); !word.empty(); word = scan_.token()) {
            if (equals_ignoring_case(word, "solid") || ends(word, "solid")) {
                open_ = equals_ignoring_case(word, "solid");
                if (!soup_.stated_unit) soup_.stated_unit = unit_in_line(scan_.rest_of_line(), scan_.line());
                scan_.next_line();  // skips the solid's name
            } else if (!equals_ignoring_case(word, "facet")) {
                return wrong(word, "facet or endsolid");
            } else if (const auto done = facet(); !done) {
                return std::unexpected(done.error());
            }
        }
        if (open_) return fail(at_line(name_, scan_.line()), "ends before endsolid", kTruncatedRemedy);
        soup_.report.vertices_merged = soup_.corners.size() - soup_.positions.size();
        return std::move(soup_);
    }

private:
    std::unexpected<Error> wrong(std::string_view word, const char* wanted) const {
        const std::string got = word.empty() ? "the end of the file" : in_quotes(word);
        return fail(at_line(name_, scan_.line()), got + " stands where '" + wanted + "' should", kTruncatedRemedy);
    }

    // Tells whether the word, or the word and the next, end what is named: "endloop", and "end loop" as some write.
    bool ends(std::string_view word, std::string_view what) {
        if (word.size() > 3 && equals_ignoring_case(word.substr(0, 3), "end"))
            return equals_ignoring_case(word.substr(3), what);
        if (!equals_ignoring_case(word, "end")) return false;
        TextScanner next = scan_;
        if (!equals_ignoring_case(next.token_in_line(), what)) return false;
        scan_ = next;
        return true;
    }

    // Reads a facet after its keyword: all words before "outer" are the normal, in whatever form.
    Result<void> facet() {
        constexpr int kMostNormalWords = 4;
        std::string_view word = scan_.token();
        for (int i = 0; i < kMostNormalWords && !equals_ignoring_case(word, "outer"); ++i) word = scan_.token();
        if (!equals_ignoring_case(word, "outer")) return wrong(word, "outer loop");
        if (word = scan_.token(); !equals_ignoring_case(word, "loop")) return wrong(word, "loop");
        std::uint32_t corners = 0;
        for (word = scan_.token(); equals_ignoring_case(word, "vertex"); word = scan_.token(), ++corners) {
            BURIN_TRY_DO(vertex());
        }
        if (!ends(word, "loop")) return wrong(word, "vertex or endloop");
        if (word = scan_.token(); !ends(word, "facet")) return wrong(word, "endfacet");
        soup_.corner_counts.push_back(corners);
        return {};
    }

    Result<void> vertex() {
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = scan_.token();
            const auto value = number_from(word);
            if (!value) return wrong(word, "a number");
            if (const char* fault = coordinate_fault(*value)) {
                return fail(at_line(name_, scan_.line()), fault, kCoordinateRemedy);
            }
            if (is_far(*value) && soup_.far.empty()) soup_.far = at_line(name_, scan_.line());
            p[k] = *value;
            soup_.precision.see(word, *value);
        }
        soup_.corners.push_back(weld_.index_of(p));
        return {};
    }

    TextScanner scan_;
    const std::string& name_;
    MeshSoup soup_;
    VertexWeld weld_;
    bool open_ = false;
};

}  // namespace

bool is_binary_stl(std::span<const std::byte> bytes) {
    return bytes.size() >= kHeaderBytes && bytes_claimed(bytes) == bytes.size();
}

Result<MeshSoup> read_stl(std::span<const std::byte> bytes, const std::string& name) {
    if (is_binary_stl(bytes)) return read_binary(bytes, name);
    const bool has_count = bytes.size() >= kHeaderBytes;
    const Result<std::string_view> text = utf8_text(text_of(bytes), name);
    if (text && looks_like_text(*text)) return AsciiStl(*text, name).read();
    // Four bytes of UTF-16, taken for a count of triangles, claim more than any file holds.
    if (!text && (!has_count || bytes_claimed(bytes) > bytes.size())) return std::unexpected(text.error());
    return read_binary(bytes, name);
}

}  // namespace burin::geometry
