// SPDX-License-Identifier: MIT
#include "geometry/files/obj_pictures.hpp"

#include <algorithm>

#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr std::size_t kMostTold = 20;  // pictures that cannot be read, each a remark

// Takes the next word off a statement.
std::string_view next_word_of(std::string_view& rest) {
    constexpr std::string_view kBlanks = " \t";
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
    rest.remove_prefix(word.size());
    return word;
}

// Takes an option's values: of an offset, a scale or a turbulence up to three numbers, of others one word or two.
void skip_values(std::string_view option, std::string_view& rest) {
    const bool has_numbers = option == "-o" || option == "-s" || option == "-t";
    const int most = has_numbers ? 3 : option == "-mm" ? 2 : 1;
    for (int i = 0; i < most; ++i) {
        std::string_view behind = rest;
        const std::string_view word = next_word_of(behind);
        if (has_numbers && !number_from(word)) return;
        rest = behind;
    }
}

}  // namespace

std::string picture_named(std::string_view statement) {
    std::string_view rest = statement;
    for (;;) {
        std::string_view behind = rest;
        const std::string_view word = next_word_of(behind);
        if (!word.starts_with('-')) break;
        rest = behind;
        skip_values(word, rest);
    }
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    while (rest.ends_with(' ') || rest.ends_with('\t')) rest.remove_suffix(1);
    std::string name(rest);
    std::ranges::replace(name, '\\', '/');
    return name;
}

const Picture* ObjPictures::named(const std::string& name) {
    if (known_.size() >= kMostObjPictures && !known_.contains(name)) return nullptr;
    const auto [at, is_new] = known_.try_emplace(name);
    if (!is_new) return at->second ? &*at->second : nullptr;
    Result<Picture> picture = opened(name);
    if (picture) {
        ++worn_;
        return &at->second.emplace(std::move(*picture));
    }
    if (remarks_.size() < kMostTold)
        remarks_.push_back("a picture is not shown, and its material has its own colour: " + picture.error().line());
    return nullptr;
}

Result<Picture> ObjPictures::opened(const std::string& name) const {
    if (!read_) return fail(name, "was not read", "save the mesh as a file");
    Result<std::string> bytes = read_(name);
    const std::size_t slash = name.rfind('/');
    if (!bytes && slash != std::string::npos)
        if (Result<std::string> beside = read_(name.substr(slash + 1))) bytes = std::move(beside);
    if (!bytes) return std::unexpected(bytes.error());
    return Picture::decode(std::as_bytes(std::span(*bytes)), name);
}

std::vector<Colour> worn_colours(const Picture& picture, std::span<const Vec2> places, const Colour& own) {
    std::vector<Colour> worn = picture.colours_of(places, {});
    if (picture.is_grey())
        for (Colour& colour : worn) colour = darkened(own, colour);
    return worn;
}

}  // namespace burin::geometry
