// SPDX-License-Identifier: MIT
// Binary STL, and PLY in its three encodings.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>

#include "tests/tools/audited_file.hpp"

namespace mesh_audit {

namespace {

template <typename T>
T load(const char* bytes, bool big_endian) {
    std::array<char, sizeof(T)> copy{};
    std::memcpy(copy.data(), bytes, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(copy);
    return std::bit_cast<T>(copy);
}

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
    const char* name;
    Type type;
    std::size_t bytes;
};

constexpr std::array<TypeName, 16> kTypeNames{{{"char", Type::int8, 1},
                                               {"int8", Type::int8, 1},
                                               {"uchar", Type::uint8, 1},
                                               {"uint8", Type::uint8, 1},
                                               {"short", Type::int16, 2},
                                               {"int16", Type::int16, 2},
                                               {"ushort", Type::uint16, 2},
                                               {"uint16", Type::uint16, 2},
                                               {"int", Type::int32, 4},
                                               {"int32", Type::int32, 4},
                                               {"uint", Type::uint32, 4},
                                               {"uint32", Type::uint32, 4},
                                               {"float", Type::float32, 4},
                                               {"float32", Type::float32, 4},
                                               {"double", Type::float64, 8},
                                               {"float64", Type::float64, 8}}};

const TypeName* type_named(const std::string& name) {
    const auto* found = std::ranges::find_if(kTypeNames, [&](const TypeName& t) { return name == t.name; });
    return found == kTypeNames.end() ? nullptr : found;
}

struct Property {
    std::string name;
    const TypeName* type = nullptr;
    const TypeName* count_type = nullptr;  // of a list; null for a scalar
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

enum class Encoding { ascii, little, big };

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::size_t body_at = 0;
    std::string failure;
};

// One header line; the complaint, or empty.
std::string read_header_line(const std::string& line, Header& header) {
    std::istringstream words(line);
    std::string keyword, first;
    words >> keyword;
    if (keyword == "format") {
        words >> first;
        if (first == "binary_little_endian") header.encoding = Encoding::little;
        if (first == "binary_big_endian") header.encoding = Encoding::big;
    } else if (keyword == "element") {
        Element element;
        if (!(words >> element.name >> element.count)) return "cannot read '" + line + "'";
        header.elements.push_back(element);
    } else if (keyword == "property") {
        Property property;
        words >> first;
        if (first == "list") {
            std::string count_type;
            words >> count_type >> first;
            property.count_type = type_named(count_type);
            if (property.count_type == nullptr) return "cannot read '" + line + "'";
        }
        property.type = type_named(first);
        if (property.type == nullptr || !(words >> property.name) || header.elements.empty()) {
            return "cannot read '" + line + "'";
        }
        header.elements.back().properties.push_back(property);
    }
    return "";
}

Header read_header(std::string_view content) {
    Header header;
    if (!content.starts_with("ply")) header.failure = "does not begin with ply";
    while (header.failure.empty()) {
        const std::size_t end = content.find('\n', header.body_at);
        if (end == std::string_view::npos) {
            header.failure = "has no end_header";
            break;
        }
        std::string line(content.substr(header.body_at, end - header.body_at));
        if (line.ends_with('\r')) line.pop_back();
        header.body_at = end + 1;
        if (line == "end_header") break;
        header.failure = read_header_line(line, header);
    }
    return header;
}

// Hands out the numbers of the body one after another, whatever their encoding.
class Body {
public:
    Body(std::string_view rest, Encoding encoding) : rest_(rest), encoding_(encoding) {}

    std::optional<double> next(const TypeName& type) {
        return encoding_ == Encoding::ascii ? next_word() : next_bytes(type);
    }

private:
    std::optional<double> next_word() {
        const std::size_t from = std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
        rest_.remove_prefix(from);
        const std::size_t length = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
        const std::string_view word = rest_.substr(0, length);
        rest_.remove_prefix(length);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || end != word.data() + word.size() || error == std::errc::invalid_argument) return {};
        if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
        return value;
    }

    std::optional<double> next_bytes(const TypeName& type) {
        if (rest_.size() < type.bytes) return {};
        const char* at = rest_.data();
        rest_.remove_prefix(type.bytes);
        const bool big = encoding_ == Encoding::big;
        switch (type.type) {
            case Type::int8: return load<std::int8_t>(at, big);
            case Type::uint8: return load<std::uint8_t>(at, big);
            case Type::int16: return load<std::int16_t>(at, big);
            case Type::uint16: return load<std::uint16_t>(at, big);
            case Type::int32: return load<std::int32_t>(at, big);
            case Type::uint32: return load<std::uint32_t>(at, big);
            case Type::float32: return load<float>(at, big);
            case Type::float64: return load<double>(at, big);
        }
        return {};
    }

    std::string_view rest_;
    Encoding encoding_;
};

// One vertex, face or other item; the complaint, or empty.
std::string read_item(const Element& element, Body& body, Mesh& mesh, std::vector<std::uint64_t>& corners) {
    const std::string short_of = "ends inside its list of " + element.name + " items, or holds no number there";
    if (element.properties.empty()) return "element " + element.name + " has no property";
    Point point;
    for (const Property& property : element.properties) {
        if (property.count_type == nullptr) {
            const auto value = body.next(*property.type);
            if (!value) return short_of;
            if (property.name == "x") point.x = *value;
            if (property.name == "y") point.y = *value;
            if (property.name == "z") point.z = *value;
            continue;
        }
        const auto count = body.next(*property.count_type);
        if (!count || *count < 0) return short_of;
        corners.clear();
        for (double i = 0; i < *count; ++i) {
            const auto value = body.next(*property.type);
            if (!value) return short_of;
            if (!(*value >= 0 && *value < 4294967295.0)) return "a list of " + element.name + " items holds no index";
            corners.push_back(static_cast<std::uint64_t>(*value));
        }
        const bool is_face = property.name == "vertex_indices" || property.name == "vertex_index";
        if (is_face && element.name == "face") {
            if (corners.size() < 3) return "a face has fewer than three corners";
            if (!append_face(mesh, corners)) return "a face names a vertex that is not there";
        }
    }
    if (element.name == "vertex") mesh.points.push_back(point);
    return "";
}

}  // namespace

Reading read_binary_stl(std::string_view content) {
    Reading reading;
    reading.mesh.format = "binary STL";
    if (content.size() < 84) return {{}, {"is too short for an STL file"}};
    const std::uint64_t count = load<std::uint32_t>(content.data() + 80, false);
    if (content.size() != 84 + 50 * count) {
        return {{}, {"claims " + std::to_string(count) + " triangles, but is not as long as that"}};
    }
    reading.mesh.points.reserve(3 * count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const char* corner = content.data() + 84 + 50 * i + 12;  // behind the normal
        for (int c = 0; c < 3; ++c, corner += 12) {
            reading.mesh.points.push_back(
                {load<float>(corner, false), load<float>(corner + 4, false), load<float>(corner + 8, false)});
        }
    }
    weld_by_bits(reading.mesh);
    return reading;
}

Reading read_ply(std::string_view content) {
    const Header header = read_header(content);
    if (!header.failure.empty()) return {{}, {header.failure}};
    Reading reading;
    reading.mesh.format = header.encoding == Encoding::ascii    ? "ASCII PLY"
                          : header.encoding == Encoding::little ? "binary little-endian PLY"
                                                                : "binary big-endian PLY";
    Body body(content.substr(header.body_at), header.encoding);
    std::vector<std::uint64_t> corners;
    for (const Element& element : header.elements) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            const std::string complaint = read_item(element, body, reading.mesh, corners);
            if (!complaint.empty()) return {{}, {complaint}};
        }
    }
    return reading;
}

}  // namespace mesh_audit
