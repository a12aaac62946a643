// SPDX-License-Identifier: MIT
// Reads ASCII OFF: [ST][C][N]OFF, three counts (vertices, faces, edges), then the vertices x y z [normal] [colour]
// [texture] and the faces n i1 .. in [colour]. Comments start with #. A colour runs to the end of its line: 3 or 4
// numbers, integers (0 to 255) or with a decimal point (0 to 1); a face's single number is an index into a map that the
// file does not hold. A comment near the beginning may state the unit.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr char kOffComment = '#';

class OffReader {
public:
    OffReader(std::string_view text, const std::string& name) : text_(text), scan_(text), name_(name) {}

    Result<MeshSoup> read() {
        soup_.report.format = "OFF";
        soup_.stated_unit = unit_in_comments(text_);
        if (auto done = header(); !done) return std::unexpected(done.error());
        for (std::uint64_t i = 0; i < vertices_; ++i) {
            if (auto done = vertex(); !done) return std::unexpected(done.error());
        }
        for (std::uint64_t i = 0; i < faces_; ++i) {
            if (auto done = face(); !done) return std::unexpected(done.error());
        }
        if (!scan_.token(kOffComment).empty()) soup_.report.remarks.push_back("text after the last face was ignored");
        if (uncoloured_ > 0) {
            soup_.report.remarks.push_back("the colour map indices of " + std::to_string(uncoloured_) +
                                           " faces were ignored");
        }
        return std::move(soup_);
    }

private:
    using Done = Result<void>;

    std::unexpected<Error> wrong(const std::string& what, const char* remedy = kTruncatedRemedy) const {
        return fail(at_line(name_, scan_.line()), what, remedy);
    }

    Done header() {
        std::string_view word = scan_.token(kOffComment);
        has_texture_ = take_prefix(word, "st");
        has_colours_ = take_prefix(word, "c");
        has_normals_ = take_prefix(word, "n");
        if (!equals_ignoring_case(word, "off")) {
            return wrong("does not begin with OFF, or with a kind of OFF other than [ST][C][N]OFF",
                         "convert it to PLY");
        }
        word = scan_.token(kOffComment);
        if (equals_ignoring_case(word, "binary")) return wrong("is a binary OFF file", "convert it to PLY");
        std::array<std::uint64_t, 3> counts{};
        for (auto& count : counts) {
            const auto value = integer_from<std::uint64_t>(word);
            if (!value) return wrong(in_quotes(word) + " stands where a count should");
            count = *value;
            if (&count != &counts.back()) word = scan_.token(kOffComment);
        }
        vertices_ = counts[0];
        faces_ = counts[1];
        // A vertex takes at least three digits and three blanks, a face a digit and a blank; allows a little less for
        // the file's end.
        const std::uint64_t room = (text_.size() - scan_.position()) / 2 + 1;
        if (vertices_ > room / 3 + 1 || faces_ > room || vertices_ * 3 + faces_ > room + 3) {
            return wrong("claims " + std::to_string(vertices_) + " vertices and " + std::to_string(faces_) +
                         " faces, more than the file can hold");
        }
        return {};
    }

    static bool take_prefix(std::string_view& word, std::string_view prefix) {
        if (word.size() <= 3 || !equals_ignoring_case(word.substr(0, prefix.size()), prefix)) return false;
        word.remove_prefix(prefix.size());
        return true;
    }

    Result<double> number() {
        const std::string_view word = scan_.token(kOffComment);
        if (word.empty()) return wrong("ends in the middle of its vertices or faces");
        const auto value = number_from(word);
        if (!value) return wrong(in_quotes(word) + " is not a number");
        return *value;
    }

    Done vertex() {
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            const auto value = number();
            if (!value) return std::unexpected(value.error());
            if (const char* fault = coordinate_fault(*value)) return wrong(fault, kCoordinateRemedy);
            p[k] = *value;
        }
        soup_.positions.push_back(p);
        for (int k = 0; has_normals_ && k < 3; ++k) {
            if (const auto value = number(); !value) return std::unexpected(value.error());
        }
        if (has_colours_) {
            auto colour = colour_in_line(has_texture_ ? 2 : 0);
            if (!colour) return std::unexpected(colour.error());
            soup_.colours.push_back(colour->value_or(kPlainColour));
        } else if (has_texture_) {
            for (int k = 0; k < 2; ++k) {
                if (const auto value = number(); !value) return std::unexpected(value.error());
            }
        }
        return {};
    }

    Done face() {
        const std::string_view word = scan_.token(kOffComment);
        if (word.empty()) return wrong("ends in the middle of its faces");
        const auto count = integer_from<std::uint32_t>(word);
        if (!count) return wrong(in_quotes(word) + " stands where a face's number of corners should");
        for (std::uint32_t i = 0; i < *count; ++i) {
            const std::string_view corner = scan_.token(kOffComment);
            if (corner.empty()) return wrong("ends in the middle of a face of " + std::to_string(*count) + " corners");
            const auto index = integer_from<std::uint32_t>(corner);
            if (!index) return wrong(in_quotes(corner) + " is not a vertex index");
            if (*index >= vertices_) {
                return wrong("a face names vertex " + std::to_string(*index) + ", but there are only " +
                                 std::to_string(vertices_) + " (counted from 0)",
                             "repair the file");
            }
            soup_.corners.push_back(*index);
        }
        soup_.corner_counts.push_back(*count);
        const auto colour = colour_in_line(0);
        if (!colour) return std::unexpected(colour.error());
        remember_face_colour(*colour);
        return {};
    }

    // Records a face's colour. Faces before the first coloured one, and uncoloured ones after it, get the plain colour.
    void remember_face_colour(const std::optional<Colour>& colour) {
        if (!colour && soup_.face_materials.empty()) return;
        while (soup_.face_materials.size() + 1 < soup_.corner_counts.size()) {
            soup_.face_materials.push_back(materials_.index_of(kPlainColour));
        }
        soup_.face_materials.push_back(materials_.index_of(colour.value_or(kPlainColour)));
    }

    // Reads the numbers up to the line's end as a colour, except the last `others`; nothing where there is no colour.
    Result<std::optional<Colour>> colour_in_line(std::size_t others) {
        std::array<double, 6> values{};
        std::size_t count = 0;
        bool whole = true;
        for (std::string_view word = scan_.token_in_line(kOffComment); !word.empty();
             word = scan_.token_in_line(kOffComment)) {
            const auto value = number_from(word);
            if (!value || !std::isfinite(*value))
                return wrong(in_quotes(word) + " stands where a colour should", "repair the file");
            if (count == values.size()) return wrong("a line has too many numbers", "write one vertex or face a line");
            if (count < 3 && word.find_first_of(".eE") != std::string_view::npos) whole = false;
            values[count++] = *value;
        }
        if (count < others) return wrong("a vertex lacks its texture coordinates");
        count -= others;
        if (count == 0) return std::optional<Colour>{};
        if (count == 1) {
            ++uncoloured_;
            return std::optional<Colour>{};
        }
        if (count != 3 && count != 4) return wrong("a colour has " + std::to_string(count) + " numbers", "give 3 or 4");
        Colour colour;
        for (std::size_t k = 0; k < 3; ++k) {
            const double scaled = whole ? values[k] : values[k] * 255.0;
            if (!(scaled >= 0.0 && scaled <= 255.0))
                return wrong("a colour lies outside its range", "use 0 to 255 or 0.0 to 1.0");
            colour[k] = static_cast<std::uint8_t>(std::lround(scaled));
        }
        return std::optional<Colour>{colour};
    }

    std::string_view text_;
    TextScanner scan_;
    const std::string& name_;
    MeshSoup soup_;
    ColourMaterials materials_{soup_.materials};
    bool has_texture_ = false, has_colours_ = false, has_normals_ = false;
    std::uint64_t vertices_ = 0, faces_ = 0, uncoloured_ = 0;
};

}  // namespace

Result<MeshSoup> read_off(std::string_view text, const std::string& name) { return OffReader(text, name).read(); }

}  // namespace burin::geometry
