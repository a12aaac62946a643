// SPDX-License-Identifier: MIT
// The header of a PLY file and the stream of values after it. Internal to geometry/.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geometry/files/mesh_unit.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class PlyRole : std::uint8_t { x, y, z, red, green, blue, s, t, corners, places, picture, other };

// Returns the least bytes that one value takes: its size, or in text a digit and a blank (the last value needs no
// blank, see PlyValues::bytes_left).
[[nodiscard]] std::uint64_t least_bytes(PlyType type, PlyEncoding encoding);

struct PlyProperty {
    PlyRole role = PlyRole::other;
    PlyType type = PlyType::f32;
    bool is_list = false;
    PlyType count_type = PlyType::u8;

    [[nodiscard]] bool is_colour() const { return role >= PlyRole::red && role <= PlyRole::blue; }
    [[nodiscard]] bool is_place() const { return role == PlyRole::s || role == PlyRole::t; }
    [[nodiscard]] bool is_places() const { return role == PlyRole::places; }
    [[nodiscard]] bool is_picture() const { return role == PlyRole::picture && !is_list; }
    [[nodiscard]] std::size_t channel() const {
        return static_cast<std::size_t>(role) - static_cast<std::size_t>(PlyRole::red);
    }
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    [[nodiscard]] bool has(PlyRole role) const;
    [[nodiscard]] bool has_position() const { return has(PlyRole::x) && has(PlyRole::y) && has(PlyRole::z); }
    [[nodiscard]] bool has_colour() const { return has(PlyRole::red) && has(PlyRole::green) && has(PlyRole::blue); }
    [[nodiscard]] bool has_place() const { return has(PlyRole::s) && has(PlyRole::t); }  // in a picture
    [[nodiscard]] bool has_corners() const { return has(PlyRole::corners); }
    [[nodiscard]] std::uint64_t least_row_bytes(PlyEncoding encoding) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::optional<StatedUnit> stated_unit;  // by a comment
    std::vector<std::string> pictures;      // what stands behind "comment TextureFile"
    std::size_t data_begin = 0;             // the byte after the header
    std::uint64_t data_line = 1;            // line number of that byte
};

// Reads the header at the start of a file, which may begin with a byte-order mark.
[[nodiscard]] Result<PlyHeader> read_ply_header(std::string_view file, const std::string& name);

// How the rows of a text stand: each in a line of its own, or one behind the other wherever lines end.
enum class PlyRows : std::uint8_t { in_lines, anyhow };

// Reads the values after the header, one after another, in any encoding.
class PlyValues {
public:
    PlyValues(std::span<const std::byte> bytes, const PlyHeader& header, PlyRows rows);

    // Go to the first value of the next row, and behind its last one. Where rows are lines, end_row() returns how many
    // words the line has left, and skips them; else 0.
    void begin_row();
    std::uint64_t end_row();
    // Counts the lines of a text that are not empty, up to `most`.
    [[nodiscard]] std::uint64_t lines(std::uint64_t most) const;

    // Returns the next value; nothing at the end of the file or at something that is not a number; then fault() says
    // which.
    [[nodiscard]] std::optional<double> next(PlyType type);
    [[nodiscard]] std::string fault() const { return fault_; }
    // Returns the word that the last value was read from; empty in a binary file.
    [[nodiscard]] std::string_view word() const { return word_; }

    // Returns how many bytes can still hold values, plus one for text, whose last value needs no blank after it.
    [[nodiscard]] std::uint64_t bytes_left() const;
    [[nodiscard]] bool only_blanks_left();

    // Returns the current line (text) or byte (binary) for messages.
    [[nodiscard]] std::uint64_t place() const;
    [[nodiscard]] std::string where(const std::string& name) const { return where(name, place()); }
    [[nodiscard]] std::string where(const std::string& name, std::uint64_t place) const;

private:
    std::optional<double> next_in_text();

    std::span<const std::byte> bytes_;  // after the header
    PlyEncoding encoding_;
    bool rows_are_lines_;
    std::size_t data_begin_;
    std::uint64_t data_line_;
    std::size_t at_ = 0;
    TextScanner scan_;
    std::string fault_;
    std::string_view word_;
};

}  // namespace burin::geometry
