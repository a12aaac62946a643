// SPDX-License-Identifier: MIT
#include "geometry/files/ply_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/unit_statement.hpp"

namespace burin::geometry {
namespace {

constexpr std::array<std::uint8_t, 8> kTypeBytes{1, 1, 2, 2, 4, 4, 4, 8};

std::optional<PlyType> type_named(std::string_view name) {
    struct Name {
        std::string_view text;
        PlyType type;
    };
    static constexpr Name kNames[] = {
        {"char", PlyType::i8},   {"int8", PlyType::i8},     {"uchar", PlyType::u8},   {"uint8", PlyType::u8},
        {"short", PlyType::i16}, {"int16", PlyType::i16},   {"ushort", PlyType::u16}, {"uint16", PlyType::u16},
        {"int", PlyType::i32},   {"int32", PlyType::i32},   {"uint", PlyType::u32},   {"uint32", PlyType::u32},
        {"float", PlyType::f32}, {"float32", PlyType::f32}, {"double", PlyType::f64}, {"float64", PlyType::f64},
    };
    for (const Name& known : kNames) {
        if (equals_ignoring_case(name, known.text)) return known.type;
    }
    return std::nullopt;
}

PlyRole role_of(std::string_view name, bool is_list) {
    const auto is = [&](std::string_view known) { return equals_ignoring_case(name, known); };
    if (is_list) {
        if (is("vertex_indices") || is("vertex_index")) return PlyRole::corners;
        return is("texcoord") ? PlyRole::places : PlyRole::other;
    }
    if (is("x")) return PlyRole::x;
    if (is("y")) return PlyRole::y;
    if (is("z")) return PlyRole::z;
    if (is("red") || is("diffuse_red") || is("r")) return PlyRole::red;
    if (is("green") || is("diffuse_green") || is("g")) return PlyRole::green;
    if (is("blue") || is("diffuse_blue") || is("b")) return PlyRole::blue;
    if (is("s") || is("u") || is("texture_u") || is("texture_s")) return PlyRole::s;
    if (is("t") || is("v") || is("texture_v") || is("texture_t")) return PlyRole::t;
    return is("texnumber") ? PlyRole::picture : PlyRole::other;
}

// Tells whether there may be but one such property: without texture coordinates a mesh is a mesh.
bool must_be_one(PlyRole role) { return role <= PlyRole::blue || role == PlyRole::corners; }

class HeaderReader {
public:
    HeaderReader(std::string_view text, const std::string& name)
        : scan_(text), name_(name), lines_end_with_cr_(begins_with_a_cr_line(text)) {}

    Result<PlyHeader> read() {
        if (!equals_ignoring_case(scan_.token_in_line(), "ply")) {
            return wrong("does not begin with 'ply'", "check that it is a PLY file");
        }
        bool has_format = false;
        for (;;) {
            scan_.next_line();
            if (scan_.at_end()) return wrong("ends inside its header", kTruncatedRemedy);
            const std::string_view keyword = scan_.token_in_line();
            if (equals_ignoring_case(keyword, "end_header")) break;
            Result<void> done;
            if (equals_ignoring_case(keyword, "format")) {
                done = format();
                has_format = true;
            } else if (equals_ignoring_case(keyword, "element")) {
                done = element();
            } else if (equals_ignoring_case(keyword, "property")) {
                done = property();
            } else if (equals_ignoring_case(keyword, "comment") || equals_ignoring_case(keyword, "obj_info")) {
                comment(scan_.rest_of_line());
            } else if (!keyword.empty()) {
                done = wrong(in_quotes(keyword) + " is not a keyword of a PLY header", "repair the header");
            }
            if (!done) return std::unexpected(done.error());
        }
        if (!has_format) return wrong("its header names no format", "repair the header");
        end_header();
        return std::move(header_);
    }

private:
    std::unexpected<Error> wrong(const std::string& what, const char* remedy) const {
        return fail(at_line(name_, scan_.line()), what, remedy);
    }

    // Tells whether the first line ends with a CR alone.
    static bool begins_with_a_cr_line(std::string_view text) {
        const std::size_t end = text.find_first_of("\r\n");
        return end != std::string_view::npos && text[end] == '\r' && !text.substr(end + 1).starts_with('\n');
    }

    // Finds the data. Behind a header whose lines end with CR a line feed is the first byte of the data.
    void end_header() {
        static_cast<void>(scan_.rest_of_line());
        const std::size_t line_end = scan_.position();
        const bool one_byte = lines_end_with_cr_ && !scan_.at_end();
        scan_.next_line();
        header_.data_begin = one_byte ? line_end + 1 : scan_.position();
        header_.data_line = scan_.line();
    }

    void comment(std::string_view text) {
        if (!header_.stated_unit) header_.stated_unit = unit_in_line(text, scan_.line());
        TextScanner words(text);
        if (equals_ignoring_case(words.token_in_line(), "texturefile"))
            header_.pictures.emplace_back(words.rest_of_line());
    }

    Result<void> format() {
        const std::string_view encoding = scan_.token_in_line();
        if (equals_ignoring_case(encoding, "ascii")) {
            header_.encoding = PlyEncoding::ascii;
        } else if (equals_ignoring_case(encoding, "binary_little_endian")) {
            header_.encoding = PlyEncoding::little_endian;
        } else if (equals_ignoring_case(encoding, "binary_big_endian")) {
            header_.encoding = PlyEncoding::big_endian;
        } else {
            return wrong(in_quotes(encoding) + " is not a PLY format",
                         "use ascii, binary_little_endian or binary_big_endian");
        }
        return {};
    }

    Result<void> element() {
        const std::string_view element_name = scan_.token_in_line();
        const std::string_view count = scan_.token_in_line();
        const auto value = integer_from<std::uint64_t>(count);
        if (!value) return wrong(in_quotes(count) + " is not a count of elements", "repair the header");
        std::string lowered;
        for (const char c : element_name) lowered += lower(c);
        const bool is_known = std::ranges::find(header_.elements, lowered, &PlyElement::name) != header_.elements.end();
        if (is_known && (lowered == "vertex" || lowered == "face"))
            return wrong("element " + in_quotes(element_name) + " is declared twice", "join its rows into one element");
        header_.elements.push_back({std::move(lowered), *value, {}});
        return {};
    }

    Result<void> property() {
        if (header_.elements.empty()) return wrong("a property comes before any element", "repair the header");
        PlyProperty property;
        std::string_view type = scan_.token_in_line();
        property.is_list = equals_ignoring_case(type, "list");
        if (property.is_list) {
            const std::string_view count_type = scan_.token_in_line();
            const auto known = type_named(count_type);
            if (!known) return wrong(in_quotes(count_type) + " is not a PLY type", "repair the header");
            property.count_type = *known;
            type = scan_.token_in_line();
        }
        const auto known = type_named(type);
        if (!known) return wrong(in_quotes(type) + " is not a PLY type", "repair the header");
        property.type = *known;
        property.role = role_of(scan_.token_in_line(), property.is_list);
        PlyElement& owner = header_.elements.back();
        if (property.role != PlyRole::other && owner.has(property.role)) {
            if (must_be_one(property.role)) return wrong("a property is declared twice", "repair the header");
            property.role = PlyRole::other;
        }
        owner.properties.push_back(property);
        return {};
    }

    TextScanner scan_;
    const std::string& name_;
    const bool lines_end_with_cr_;
    PlyHeader header_;
};

template <typename T>
double decoded(const std::byte* at, bool swapped) {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), at, sizeof(T));
    if (swapped) std::ranges::reverse(raw);
    return static_cast<double>(std::bit_cast<T>(raw));
}

}  // namespace

std::uint64_t least_bytes(PlyType type, PlyEncoding encoding) {
    return encoding == PlyEncoding::ascii ? 2 : kTypeBytes[static_cast<std::size_t>(type)];
}

bool PlyElement::has(PlyRole role) const {
    return std::ranges::any_of(properties, [&](const PlyProperty& p) { return p.role == role; });
}

std::uint64_t PlyElement::least_row_bytes(PlyEncoding encoding) const {
    std::uint64_t sum = 0;
    for (const PlyProperty& p : properties) sum += least_bytes(p.is_list ? p.count_type : p.type, encoding);
    return sum;
}

Result<PlyHeader> read_ply_header(std::string_view file, const std::string& name) {
    BURIN_TRY(text, utf8_text(file, name));
    Result<PlyHeader> header = HeaderReader(text, name).read();
    if (header) header->data_begin += file.size() - text.size();
    return header;
}

PlyValues::PlyValues(std::span<const std::byte> bytes, const PlyHeader& header, PlyRows rows)
    : bytes_(bytes.subspan(header.data_begin)),
      encoding_(header.encoding),
      rows_are_lines_(encoding_ == PlyEncoding::ascii && rows == PlyRows::in_lines),
      data_begin_(header.data_begin),
      data_line_(header.data_line),
      scan_(text_of(bytes_)) {}

void PlyValues::begin_row() {
    if (!rows_are_lines_) return;
    const auto is_empty = [](TextScanner line) { return line.token_in_line().empty(); };
    while (!scan_.at_end() && is_empty(scan_)) scan_.next_line();
}

std::uint64_t PlyValues::end_row() {
    std::uint64_t left = 0;
    if (!rows_are_lines_) return left;
    while (!scan_.token_in_line().empty()) ++left;
    scan_.next_line();
    return left;
}

std::uint64_t PlyValues::lines(std::uint64_t most) const {
    TextScanner rest(text_of(bytes_));
    std::uint64_t count = 0;
    for (; count < most && !rest.token().empty(); rest.next_line()) ++count;
    return count;
}

std::optional<double> PlyValues::next(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) return next_in_text();
    const std::size_t size = kTypeBytes[static_cast<std::size_t>(type)];
    if (bytes_.size() - at_ < size) {
        fault_ = "ends in the middle of its data";
        return std::nullopt;
    }
    const std::byte* at = bytes_.data() + at_;
    at_ += size;
    const bool swapped = (encoding_ == PlyEncoding::little_endian) != (std::endian::native == std::endian::little);
    switch (type) {
        case PlyType::i8: return decoded<std::int8_t>(at, swapped);
        case PlyType::u8: return decoded<std::uint8_t>(at, swapped);
        case PlyType::i16: return decoded<std::int16_t>(at, swapped);
        case PlyType::u16: return decoded<std::uint16_t>(at, swapped);
        case PlyType::i32: return decoded<std::int32_t>(at, swapped);
        case PlyType::u32: return decoded<std::uint32_t>(at, swapped);
        case PlyType::f32: return decoded<float>(at, swapped);
        case PlyType::f64: return decoded<double>(at, swapped);
    }
    return std::nullopt;
}

std::optional<double> PlyValues::next_in_text() {
    const std::string_view word = word_ = rows_are_lines_ ? scan_.token_in_line() : scan_.token();
    if (word.empty()) {
        fault_ = scan_.at_end() ? "ends in the middle of its data" : "its row has fewer numbers than the header says";
        return std::nullopt;
    }
    const auto value = number_from(word);
    if (!value) fault_ = in_quotes(word) + " is not a number";
    return value;
}

std::uint64_t PlyValues::bytes_left() const {
    return encoding_ == PlyEncoding::ascii ? bytes_.size() - scan_.position() + 1 : bytes_.size() - at_;
}

bool PlyValues::only_blanks_left() {
    return encoding_ == PlyEncoding::ascii ? scan_.token().empty() : at_ == bytes_.size();
}

std::uint64_t PlyValues::place() const {
    return encoding_ == PlyEncoding::ascii ? data_line_ + scan_.line() - 1 : data_begin_ + at_;
}

std::string PlyValues::where(const std::string& name, std::uint64_t place) const {
    return encoding_ == PlyEncoding::ascii ? at_line(name, place) : at_byte(name, place);
}

}  // namespace burin::geometry
