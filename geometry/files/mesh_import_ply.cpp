// SPDX-License-Identifier: MIT
// Reads PLY 1.0, ASCII and binary of both byte orders: element vertex (x, y, z and red, green, blue), element face
// (vertex_indices or vertex_index, and red, green, blue). Pictures that comments name (TextureFile) are worn by
// coordinates of the faces' corners (texcoord, with texnumber) or of the vertices (s, t or u, v). Other elements and
// properties are skipped; skipped elements are named in a remark. Triangle strips are refused rather than lost. A
// header's count is compared with the bytes that follow. A comment or obj_info line of the header may state the unit.
// In ASCII a row is a line: what is too much in it is skipped, and named in a remark, and what it lacks is a fault of
// that line. A text may have its rows anyhow where they do not keep to lines from the first on, and where lines are
// more or fewer than rows; then it must end with the last row.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/try.hpp"
#include "geometry/files/mesh_pictures.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/ply_header.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr Vec2 kNoPlace{std::numeric_limits<double>::quiet_NaN()};

// A colour as the file has it.
struct PlyColour {
    Vec3 numbers{0.0};
    bool has_floats = false;
    std::uint64_t place = 0;  // its line, or byte
};

class PlyReader {
public:
    PlyReader(std::span<const std::byte> bytes, const std::string& name, PlyHeader header, PlyRows rows,
              const MaterialFileReader& pictures)
        : name_(name), header_(std::move(header)), rows_(rows), values_(bytes, header_, rows), pictures_(pictures) {}

    Result<MeshSoup> read() {
        soup_.stated_unit = header_.stated_unit;
        soup_.has_bytes = header_.encoding != PlyEncoding::ascii;
        soup_.report.format = header_.encoding == PlyEncoding::ascii           ? "PLY, ASCII"
                              : header_.encoding == PlyEncoding::little_endian ? "PLY, binary little endian"
                                                                               : "PLY, binary big endian";
        if (rows_ == PlyRows::anyhow && has_a_line_for_each_row()) return wrong("a line is no row");
        for (const PlyElement& element : header_.elements) {
            BURIN_TRY_DO(read_element(element));
        }
        if (rows_ == PlyRows::anyhow && !values_.only_blanks_left()) return wrong("data stand behind the last element");
        BURIN_TRY_DO(check_corners());
        resolve_colours();
        wear_textures();
        if (ignored_ > 0) {
            soup_.report.remarks.push_back(std::to_string(ignored_) +
                                           " other kinds of element were ignored, the first is " +
                                           in_quotes(first_ignored_));
        }
        if (long_rows_ > 0) {
            soup_.report.remarks.push_back(std::to_string(long_rows_) +
                                           " rows have more numbers than the header says, the first in line " +
                                           std::to_string(first_long_row_) + "; what is too much was skipped");
        }
        if (!values_.only_blanks_left()) soup_.report.remarks.push_back("data after the last element were ignored");
        return std::move(soup_);
    }

    // Tells whether most rows were lines of the element that was read last: then the others have a fault.
    // Where an element before did not keep to lines, the lines of this one prove nothing.
    [[nodiscard]] bool keeps_to_lines() const { return !left_lines_ && whole_rows_ > 0 && rows_are_whole(); }

private:
    using Done = Result<void>;

    std::unexpected<Error> wrong(const std::string& what,
                                 const char* remedy = "repair the file or export it again") const {
        return fail(values_.where(name_), what, remedy);
    }

    [[nodiscard]] bool has_a_line_for_each_row() const {
        std::uint64_t rows = 0;
        for (const PlyElement& element : header_.elements) rows += element.properties.empty() ? 0 : element.count;
        return values_.lines(rows + 1) == rows;
    }

    void end_row() {
        const std::uint64_t line = values_.place();
        const bool is_long = values_.end_row() > 0;
        if (is_long && long_rows_++ == 0) first_long_row_ = line;
        whole_rows_ += is_long ? 0 : 1;
        ++rows_read_;
    }

    [[nodiscard]] bool rows_are_whole() const { return 2 * whole_rows_ >= rows_read_; }

    Done read_element(const PlyElement& element) {
        left_lines_ = left_lines_ || !rows_are_whole();
        whole_rows_ = rows_read_ = 0;
        if (element.least_row_bytes(header_.encoding) > 0 &&
            element.count > values_.bytes_left() / element.least_row_bytes(header_.encoding)) {
            return wrong("claims " + std::to_string(element.count) + " of " + in_quotes(element.name) +
                             ", more than the file can hold",
                         kTruncatedRemedy);
        }
        if (element.properties.empty()) return {};  // its rows take no bytes
        if (element.name == "vertex") return read_vertices(element);
        if (element.name == "face") return read_faces(element);
        if (element.count == 0) return {};
        if (element.name == "tristrips") return wrong("holds triangle strips", "convert them to triangles");
        if (ignored_++ == 0) first_ignored_ = element.name;
        return skip_rows(element);
    }

    Done skip_rows(const PlyElement& element) {
        for (std::uint64_t row = 0; row < element.count; ++row) {
            values_.begin_row();
            for (const PlyProperty& property : element.properties) {
                BURIN_TRY_DO(skip(property));
            }
            end_row();
        }
        return {};
    }

    // Returns the next value, of whatever kind.
    Result<double> any_value(PlyType type) {
        const auto read = values_.next(type);
        if (!read) return wrong(values_.fault(), kTruncatedRemedy);
        return *read;
    }
    // Returns the next value that counts: of an integer type it is whole, in a text as well.
    Result<double> value(PlyType type) { return whole_where_due(any_value(type), type, false); }
    Result<double> whole_where_due(const Result<double>& read, PlyType type, bool may_be_none) const {
        const bool is_float = type == PlyType::f32 || type == PlyType::f64;
        if (!read || is_float || *read == std::floor(*read) || (may_be_none && std::isnan(*read))) return read;
        return wrong(in_quotes(values_.word()) + " stands where a whole number should, as its property's type says",
                     "declare the property as float, or write whole numbers");
    }

    Result<std::uint64_t> list_length(const PlyProperty& property) {
        const auto length = value(property.count_type);
        if (!length) return std::unexpected(length.error());
        if (!(*length >= 0.0) || *length != std::floor(*length) || *length > 4294967295.0) {
            return wrong("a list has an impossible length");
        }
        const auto count = static_cast<std::uint64_t>(*length);
        if (count > values_.bytes_left() / least_bytes(property.type, header_.encoding)) {
            return wrong("a list claims " + std::to_string(count) + " values, more than the file can hold",
                         kTruncatedRemedy);
        }
        return count;
    }

    Done skip(const PlyProperty& property) {
        std::uint64_t count = 1;
        if (property.is_list) {
            BURIN_TRY(length, list_length(property));
            count = length;
        }
        for (; count > 0; --count) {
            BURIN_TRY_DO(any_value(property.type));
        }
        return {};
    }

    // Whole numbers run to 255, or to 65535 where they have 16 bits. Of floats only the whole file tells the range.
    // "nan" in a text is no colour, whatever the type.
    Done colour_channel(const PlyProperty& property, PlyColour& colour) {
        BURIN_TRY(read, whole_where_due(any_value(property.type), property.type, true));
        colour.place = values_.place();
        colour.has_floats = colour.has_floats || property.type == PlyType::f32 || property.type == PlyType::f64;
        colour.numbers[static_cast<int>(property.channel())] =
            property.type == PlyType::u16 ? std::round(read / 257.0) : read;
        return {};
    }

    void see(const PlyColour& colour) { (colour.has_floats ? floats_ : whole_).see(colour.numbers); }
    Colour bytes_of(const PlyColour& colour) {
        const std::string place =
            (header_.encoding == PlyEncoding::ascii ? "line " : "byte ") + std::to_string(colour.place);
        return (colour.has_floats ? floats_ : whole_).bytes_of(colour.numbers, place);
    }

    // Converts the colours of vertices and faces, which may be of different types.
    void resolve_colours() {
        whole_.see(Vec3(255.0));  // the type says that these run to 255
        for (const PlyColour& colour : vertex_colours_) soup_.colours.push_back(bytes_of(colour));
        for (const PlyColour& colour : face_colours_)
            soup_.face_materials.push_back(materials_.index_of(bytes_of(colour)));
        for (const ColourScale* scale : {&floats_, &whole_}) {
            std::ranges::move(scale->remarks("colours"), std::back_inserter(soup_.report.remarks));
        }
    }

    void see_precision(double coordinate) {
        if (header_.encoding == PlyEncoding::ascii) {
            soup_.precision.see(values_.word(), coordinate);
        } else {
            soup_.precision.see(coordinate);
        }
    }

    Done read_vertices(const PlyElement& element) {
        if (!element.has_position()) {
            return element.count == 0 ? Done{} : wrong("its vertices lack x, y or z");
        }
        const bool coloured = element.has_colour(), placed = element.has_place();
        soup_.positions.reserve(element.count);
        if (coloured) vertex_colours_.reserve(element.count);
        for (std::uint64_t row = 0; row < element.count; ++row, end_row()) {
            values_.begin_row();
            Vec3 p(0.0);
            Vec2 place(0.0);
            std::uint64_t where = 0;  // of a coordinate that no mesh can have, or of the last
            PlyColour colour;
            for (const PlyProperty& property : element.properties) {
                if (property.role == PlyRole::x || property.role == PlyRole::y || property.role == PlyRole::z) {
                    BURIN_TRY(read, value(property.type));
                    p[static_cast<int>(property.role) - static_cast<int>(PlyRole::x)] = read;
                    if (coordinate_fault(read) == nullptr) see_precision(read);
                    if (where == 0 || coordinate_fault(read) != nullptr) where = values_.place();
                } else if (placed && property.is_place()) {
                    BURIN_TRY(read, any_value(property.type));
                    place[property.role == PlyRole::s ? 0 : 1] = read;
                } else if (auto done =
                               coloured && property.is_colour() ? colour_channel(property, colour) : skip(property);
                           !done) {
                    return done;
                }
            }
            add_vertex(soup_, p, where);
            if (placed) vertex_places_.push_back(place);
            if (!coloured) continue;
            see(colour);
            vertex_colours_.push_back(colour);
        }
        return {};
    }

    Done read_faces(const PlyElement& element) {
        if (!element.has_corners()) {
            return element.count == 0 ? Done{} : wrong("its faces lack the list vertex_indices");
        }
        const bool coloured = element.has_colour();
        has_face_places_ = std::ranges::any_of(element.properties, &PlyProperty::is_places);
        soup_.corner_counts.reserve(element.count);
        for (std::uint64_t row = 0; row < element.count; ++row, end_row()) {
            values_.begin_row();
            PlyColour colour;
            for (const PlyProperty& property : element.properties) {
                auto done = property.role == PlyRole::corners  ? corners(property)
                            : property.is_places()             ? list(property, row_places_)
                            : property.is_picture()            ? number(property, row_picture_)
                            : coloured && property.is_colour() ? colour_channel(property, colour)
                                                               : skip(property);
                if (!done) return done;
            }
            note_places();
            if (!coloured) continue;
            see(colour);
            face_colours_.push_back(colour);
        }
        return {};
    }

    Done corners(const PlyProperty& property) {
        BURIN_TRY(length, list_length(property));
        for (std::uint64_t i = 0; i < length; ++i) {
            BURIN_TRY(read, value(property.type));
            if (!(read >= 0.0) || read > 4294967295.0 || read != std::floor(read))
                return wrong("a face has an impossible index");
            const auto corner = static_cast<std::uint32_t>(read);
            if (corner > farthest_corner_ || farthest_where_ == 0) {
                farthest_corner_ = corner;
                farthest_where_ = values_.place();
            }
            soup_.corners.push_back(corner);
        }
        soup_.corner_counts.push_back(static_cast<std::uint32_t>(length));
        return {};
    }

    // ---- Pictures
    // What is wrong with texture coordinates is no error: the surface does not depend on them.

    Done number(const PlyProperty& property, double& value) {
        BURIN_TRY(read, any_value(property.type));
        value = read;
        return {};
    }

    Done list(const PlyProperty& property, std::vector<double>& values) {
        values.clear();
        BURIN_TRY(length, list_length(property));
        for (std::uint64_t i = 0; i < length; ++i) {
            BURIN_TRY(read, any_value(property.type));
            values.push_back(read);
        }
        return {};
    }

    // Takes note of where the corners of the face that was read last lie in which picture.
    void note_places() {
        const bool is_known = row_picture_ >= 0.0 && row_picture_ < static_cast<double>(header_.pictures.size());
        worn_.use_of_face.push_back(is_known ? static_cast<std::uint32_t>(row_picture_) : kNoPicture);
        if (!has_face_places_) return;
        const std::uint32_t count = soup_.corner_counts.back();
        const bool is_sound = row_places_.size() == std::size_t{2} * count;
        for (std::size_t k = 0; k < count; ++k)
            worn_.places.push_back(is_sound ? Vec2(row_places_[2 * k], row_places_[2 * k + 1]) : kNoPlace);
    }

    void wear_textures() {
        const bool has_places = has_face_places_ || !vertex_places_.empty();
        if (header_.pictures.empty() && has_places)
            soup_.report.remarks.emplace_back(
                "its texture coordinates were ignored: no comment TextureFile names a picture");
        if (!header_.pictures.empty() && !has_places)
            soup_.report.remarks.push_back("picture " + in_quotes(header_.pictures.front()) +
                                           " is not shown: there are no texture coordinates");
        if (header_.pictures.empty() || !has_places) return;
        for (const std::string& statement : header_.pictures) worn_.uses.emplace_back().names = names_in(statement);
        if (!has_face_places_)
            for (const std::uint32_t corner : soup_.corners) worn_.places.push_back(vertex_places_[corner]);
        wear_pictures(soup_, worn_, pictures_);
    }

    // Checks indices after reading everything, since faces may come before vertices.
    Done check_corners() {
        if (soup_.corners.empty() || farthest_corner_ < soup_.positions.size()) return {};
        return fail(values_.where(name_, farthest_where_),
                    "a face names vertex " + std::to_string(farthest_corner_) + ", but there are only " +
                        std::to_string(soup_.positions.size()) + " (counted from 0)",
                    "repair the file or export it again");
    }

    const std::string& name_;
    PlyHeader header_;
    const PlyRows rows_;
    PlyValues values_;
    const MaterialFileReader& pictures_;
    MeshSoup soup_;
    ColourMaterials materials_{soup_.materials};
    std::vector<PlyColour> vertex_colours_, face_colours_;
    ColourScale floats_, whole_;
    WornFaces worn_;
    std::vector<Vec2> vertex_places_;
    std::vector<double> row_places_;  // of the face that was read last
    double row_picture_ = 0.0;
    bool has_face_places_ = false;
    std::uint32_t farthest_corner_ = 0;
    std::uint64_t farthest_where_ = 0;
    std::uint64_t ignored_ = 0;
    std::string first_ignored_;
    std::uint64_t whole_rows_ = 0, rows_read_ = 0;      // of one element; those with no number too many
    bool left_lines_ = false;                           // an element before had most of its rows otherwise
    std::uint64_t long_rows_ = 0, first_long_row_ = 0;  // with more numbers than the header says
};

}  // namespace

Result<MeshSoup> read_ply(std::span<const std::byte> bytes, const std::string& name,
                          const MaterialFileReader& pictures) {
    BURIN_TRY(header, read_ply_header(text_of(bytes), name));
    PlyReader reader(bytes, name, header, PlyRows::in_lines, pictures);
    Result<MeshSoup> in_lines = reader.read();
    if (in_lines || header.encoding != PlyEncoding::ascii || reader.keeps_to_lines()) return in_lines;
    Result<MeshSoup> anyhow = PlyReader(bytes, name, std::move(header), PlyRows::anyhow, pictures).read();
    return anyhow ? std::move(anyhow) : std::move(in_lines);
}

}  // namespace burin::geometry
