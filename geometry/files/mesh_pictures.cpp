// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/files/surface_colours.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr std::size_t kMostTold = 20;  // pictures that cannot be read, each a remark
constexpr std::string_view kSpaces = " \t";
constexpr Colour kWhite{255, 255, 255};

// An option of a map statement, and what follows it.
struct MapOption {
    std::string_view name;
    int least, most;  // words
    bool numbers;     // they are numbers
};
constexpr MapOption kMapOptions[] = {{"-blendu", 1, 1, false}, {"-blendv", 1, 1, false},  {"-boost", 1, 1, true},
                                     {"-mm", 1, 2, true},      {"-o", 1, 3, true},        {"-s", 1, 3, true},
                                     {"-t", 1, 3, true},       {"-texres", 1, 1, true},   {"-clamp", 1, 1, false},
                                     {"-bm", 1, 1, true},      {"-imfchan", 1, 1, false}, {"-type", 1, 1, false},
                                     {"-cc", 1, 1, false}};

const MapOption* map_option(std::string_view word) {
    const auto* const found =
        std::ranges::find_if(kMapOptions, [&](const MapOption& o) { return equals_ignoring_case(word, o.name); });
    return found == std::end(kMapOptions) ? nullptr : found;
}

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
    return text.substr(0, text.find_last_not_of(kSpaces) + 1);
}

// Takes the next word off a statement.
std::string_view next_word_of(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kSpaces), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(kSpaces));
    rest.remove_prefix(word.size());
    return word;
}

// Takes an option's values.
std::vector<std::string_view> values_of(const MapOption& option, std::string_view& rest) {
    std::vector<std::string_view> values;
    for (int i = 0; i < option.most; ++i) {
        std::string_view behind = rest;
        const std::string_view word = next_word_of(behind);
        if (word.empty() || (option.numbers && !number_from(word))) break;
        values.push_back(word);
        rest = behind;
    }
    return values;
}

// Takes note of an option, or of it as one that changes nothing here.
void apply(const MapOption& option, const std::vector<std::string_view>& values, PictureUse& use) {
    std::vector<double> numbers;
    for (const std::string_view word : values)
        if (const auto value = number_from(word); value && std::isfinite(*value)) numbers.push_back(*value);
    const bool is_sound = std::ssize(values) >= option.least && (!option.numbers || numbers.size() == values.size());
    const std::string_view word = values.empty() ? std::string_view() : values[0];
    const bool is_on = equals_ignoring_case(word, "on"), is_off = equals_ignoring_case(word, "off");
    const auto is = [&](std::string_view name) { return option.name == name; };
    bool counts = is_sound;
    if (is_sound && is("-s")) {
        use.scale = {numbers[0], numbers.size() > 1 ? numbers[1] : 1.0};
    } else if (is_sound && is("-o")) {
        use.offset = {numbers[0], numbers.size() > 1 ? numbers[1] : 0.0};
    } else if (is_sound && is("-mm")) {
        use.base = numbers[0];
        if (numbers.size() > 1) use.gain = numbers[1];
    } else if (is("-clamp") && (is_on || is_off)) {
        use.wrap = {is_off, is_off};
    } else if (is("-blendu") || is("-blendv")) {
        counts = is_on;  // pictures are blended here
    } else if (is("-cc")) {
        counts = is_off;
    } else if (is("-t")) {
        counts = is_sound && std::ranges::all_of(numbers, [](double n) { return n == 0.0; });
    } else {
        counts = false;
    }
    if (counts) return;
    std::string told(option.name);
    for (const std::string_view value : values) told += " " + std::string(value);
    use.ignored.push_back(std::move(told));
}

// Skips what looks like the values of an option that no standard has.
std::string_view behind_values(std::string_view rest) {
    for (std::string_view behind = rest; !trimmed(behind).empty();) {
        const std::string_view word = next_word_of(behind);
        const bool is_value =
            number_from(word) || equals_ignoring_case(word, "on") || equals_ignoring_case(word, "off");
        if (!is_value || trimmed(behind).empty()) break;
        rest = behind;
    }
    return trimmed(rest);
}

// Finds the next option behind a name, as some programs write them.
std::size_t option_behind(std::string_view rest) {
    for (std::size_t at = rest.find(" -"); at != std::string_view::npos; at = rest.find(" -", at + 1)) {
        std::string_view behind = rest.substr(at + 1);
        if (map_option(next_word_of(behind)) != nullptr) return at;
    }
    return std::string_view::npos;
}

Colour in_range(const Colour& colour, const PictureUse& use) {
    if (use.base == 0.0 && use.gain == 1.0) return colour;
    Colour made{};
    for (std::size_t c = 0; c < 3; ++c)
        made[c] =
            static_cast<std::uint8_t>(std::lround(std::clamp(255.0 * use.base + use.gain * colour[c], 0.0, 255.0)));
    return made;
}

}  // namespace

std::vector<std::string> names_in(std::string_view rest) {
    constexpr std::size_t kLongestName = 4096, kMostReadings = 16;  // PATH_MAX; and more than any name has
    std::vector<std::string> names;
    const auto add = [&](std::string_view name) {
        if (trimmed(name).size() > kLongestName) return;
        std::string slashed(trimmed(name));
        std::ranges::replace(slashed, '\\', '/');
        if (!slashed.empty() && std::ranges::find(names, slashed) == names.end()) names.push_back(std::move(slashed));
    };
    const auto add_unquoted = [&](std::string_view name) {
        const std::size_t end = name.size() > 1 && (name.front() == '"' || name.front() == '\'')
                                    ? name.find(name.front(), 1)
                                    : std::string_view::npos;
        add(name);
        if (end != std::string_view::npos) add(name.substr(1, end - 1));
    };
    rest = trimmed(rest);
    add_unquoted(rest);
    for (std::size_t hash = rest.rfind('#'); hash != std::string_view::npos && hash > 0 && names.size() < kMostReadings;
         hash = rest.rfind('#', hash - 1))
        if (kSpaces.contains(rest[hash - 1])) add_unquoted(trimmed(rest.substr(0, hash)));
    return names;
}

PictureUse picture_use(std::string_view statement) {
    PictureUse use;
    std::string_view rest = trimmed(statement), name;
    while (!rest.empty()) {
        std::string_view behind = rest;
        const std::string_view word = next_word_of(behind);
        const MapOption* const option = map_option(word);
        if (option != nullptr) {
            rest = behind;
            apply(*option, values_of(*option, rest), use);
            rest = trimmed(rest);
        } else if (name.empty() && word.starts_with('-') && !trimmed(behind).empty()) {
            use.ignored.emplace_back(word);
            rest = behind_values(behind);
        } else if (name.empty()) {
            const std::size_t end = option_behind(rest);
            name = rest.substr(0, end);
            rest = end == std::string_view::npos ? "" : trimmed(rest.substr(end));
        } else {
            break;  // a comment behind options behind the name
        }
    }
    use.names = names_in(name);
    return use;
}

const Picture* MeshPictures::worn_by(const PictureUse& use) {
    if (use.names.empty()) return nullptr;
    const std::string& name = use.names.front();
    if (known_.size() >= kMostMeshPictures && !known_.contains(name)) return nullptr;
    const auto [at, is_new] = known_.try_emplace(name);
    if (!is_new) return at->second ? &*at->second : nullptr;
    Result<Picture> picture = opened(use.names);
    if (picture) {
        worn_.push_back(use.names.back());
        return &at->second.emplace(std::move(*picture));
    }
    if (remarks_.size() < kMostTold)
        remarks_.push_back("a picture is not shown, and its faces have their own colour: " + picture.error().line());
    return nullptr;
}

Result<Picture> MeshPictures::opened(const std::vector<std::string>& names) const {
    if (!read_) return fail(names.back(), "was not read", "save the mesh as a file");
    std::vector<std::string> places = names;
    for (const std::string& name : names)
        if (const std::size_t slash = name.rfind('/'); slash != std::string::npos)
            places.push_back(name.substr(slash + 1));
    for (const std::string& place : places)
        if (const Result<std::string> bytes = read_(place))
            return Picture::decode(std::as_bytes(std::span(*bytes)), place);
    return std::unexpected(read_(names.back()).error());
}

void wear_pictures(MeshSoup& soup, const WornFaces& faces, const MaterialFileReader& read) {
    MeshPictures pictures(read);
    const std::size_t materials_before = soup.materials.size();
    ColourMaterials means(soup.materials);
    const bool has_materials = !soup.face_materials.empty(), has_colours = !soup.colours.empty();
    std::vector<Colour> worn;
    std::vector<std::uint32_t> materials;
    std::vector<Vec2> places;
    std::size_t first = 0;
    for (std::size_t face = 0; face < soup.corner_counts.size(); ++face) {
        const std::uint32_t count = soup.corner_counts[face], at = faces.use_of_face[face];
        const Picture* const picture = at == kNoPicture ? nullptr : pictures.worn_by(faces.uses[at]);
        places.clear();
        for (const Vec2& place : std::span(faces.places).subspan(first, count))
            if (picture != nullptr && std::isfinite(place.x) && std::isfinite(place.y))
                places.push_back(place * faces.uses[at].scale + faces.uses[at].offset);
        const bool wears = picture != nullptr && count > 0 && places.size() == count;
        const Colour own = has_materials ? soup.materials[soup.face_materials[face]].colour
                           : wears       ? kWhite
                                         : kPlainColour;
        const std::vector<Colour> of_picture =
            wears ? picture->colours_of(places, faces.uses[at].wrap) : std::vector<Colour>();
        for (std::uint32_t k = 0; k < count; ++k) {
            const Colour bare = has_colours ? soup.colours[soup.corners[first + k]] : own;
            const Colour seen = wears ? in_range(of_picture[k], faces.uses[at]) : kWhite;
            worn.push_back(!wears ? bare : has_colours || picture->is_grey() ? darkened(bare, seen) : seen);
        }
        const bool keeps_material = has_materials && !wears && !has_colours;
        materials.push_back(keeps_material ? soup.face_materials[face]
                                           : means.index_of(mean_of(std::span(worn).subspan(first, count))));
        first += count;
    }
    std::ranges::copy(pictures.remarks(), std::back_inserter(soup.report.remarks));
    if (pictures.worn().empty()) return soup.materials.resize(materials_before);
    soup.report.pictures = pictures.worn();
    soup.corner_colours = std::move(worn);
    soup.face_materials = std::move(materials);
    soup.colours.clear();
}

}  // namespace burin::geometry
