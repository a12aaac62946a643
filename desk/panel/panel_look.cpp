// SPDX-License-Identifier: MIT
#include "desk/panel/panel_look.hpp"

#include "desk/panel/fallback_type.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

namespace burin::session::panel {

namespace {

constexpr float kText_px = 16.0f, kSmall_px = 14.0f, kTitle_px = 22.0f;

struct TypeFiles {
    const char* regular;
    const char* medium;
};
// Paths of the fonts as Debian's packages fonts-roboto-unhinted and fonts-dejavu-core install them.
constexpr std::array<TypeFiles, 2> kKnownFiles{
    {{"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
      "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf"},
     {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"}}};

// Returns a font file's bytes; empty for a file that is absent or does not begin as TrueType or OpenType: the toolkit
// aborts the program at such files.
std::vector<char> bytes_of_type(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const std::string_view head(bytes.data(), std::min<std::size_t>(4, bytes.size()));
    const bool known = head == std::string_view("\0\1\0\0", 4) || head == "OTTO" || head == "true" || head == "ttcf";
    return known && bytes.size() > 1024 ? bytes : std::vector<char>{};
}

// A font file's bytes, and which font of them; the letters that are rasterised, as the toolkit wants them.
struct TypeSource {
    std::vector<char> bytes;
    int index = 0;
    std::vector<ImWchar> ranges;  // pairs, ended by 0
};

ImFont* add(const TypeSource& source, float size_px, bool to_the_last = false) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.FontNo = source.index;
    config.MergeMode = to_the_last;
    config.GlyphRanges = source.ranges.data();
    config.OversampleH = to_the_last ? 1 : 2;  // letters lie between pixels across, not down
    config.PixelSnapH = false;
    const std::vector<char>& bytes = source.bytes;
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<char*>(bytes.data()), static_cast<int>(bytes.size()),
                                                      std::round(size_px), &config);
}

void add_own_letters(Type& type, float scale) {
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale);
    type.text = type.small = type.strong = type.title = ImGui::GetIO().Fonts->AddFontDefault(&config);
}

std::vector<ImWchar> ranges_of(std::span<const std::uint32_t> letters, bool with_latin) {
    std::vector<ImWchar> ranges;
    if (with_latin) ranges = {0x20, 0xFF};
    for (const std::uint32_t letter : letters) ranges.insert(ranges.end(), 2, static_cast<ImWchar>(letter));
    ranges.push_back(0);
    return ranges;
}

// The fonts of one panel, rasterised together; a fallback's letters go into each of them.
Type rasterise(const TypeSource& regular, const TypeSource& strong, const TypeSource* fallback, float scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    const auto both = [&](const TypeSource& source, float size_px) {
        ImFont* const font = add(source, size_px * scale);
        if (fallback != nullptr) add(*fallback, size_px * scale, true);
        return font;
    };
    Type type;
    type.text = both(regular, kText_px);
    type.small = both(regular, kSmall_px);
    type.strong = both(strong, kText_px);
    type.title = both(strong, kTitle_px);
    atlas.Build();  // while the bytes exist
    return type;
}

std::vector<std::uint32_t> missing_in(const ImFont& font, std::span<const std::uint32_t> letters) {
    std::vector<std::uint32_t> missing;
    for (const std::uint32_t letter : letters)
        if (font.FindGlyphNoFallback(static_cast<ImWchar>(letter)) == nullptr) missing.push_back(letter);
    return missing;
}

std::string as_utf8(std::uint32_t letter) {
    const auto byte = [](std::uint32_t value) { return static_cast<char>(static_cast<unsigned char>(value)); };
    if (letter < 0x800) return {byte(0xC0 | (letter >> 6)), byte(0x80 | (letter & 0x3F))};
    return {byte(0xE0 | (letter >> 12)), byte(0x80 | ((letter >> 6) & 0x3F)), byte(0x80 | (letter & 0x3F))};
}

ImVec4 shade(ImU32 colour) { return ImGui::ColorConvertU32ToFloat4(colour); }

}  // namespace

void apply_style(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = style.FramePadding = {8.0f, 4.0f};
    style.WindowRounding = style.ChildRounding = 0.0f;
    style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = 0.0f;
    style.PopupBorderSize = 1.0f;
    style.PopupRounding = 6.0f;
    style.FrameRounding = style.GrabRounding = 5.0f;
    style.ScrollbarSize = 7.0f;
    style.ScrollbarRounding = 4.0f;
    style.ItemSpacing = {6.0f, 5.0f};
    style.ScaleAllSizes(scale);
    style.Colors[ImGuiCol_WindowBg] = style.Colors[ImGuiCol_ChildBg] = {0.0f, 0.0f, 0.0f, 0.0f};
    style.Colors[ImGuiCol_PopupBg] = shade(with_alpha(kField, 248));
    style.Colors[ImGuiCol_Border] = shade(kControl);
    style.Colors[ImGuiCol_Text] = shade(kText);
    style.Colors[ImGuiCol_FrameBg] = style.Colors[ImGuiCol_FrameBgHovered] = style.Colors[ImGuiCol_FrameBgActive] =
        shade(kField);
    style.Colors[ImGuiCol_TextSelectedBg] = shade(with_alpha(kAccent, 110));
    style.Colors[ImGuiCol_ScrollbarBg] = {0.0f, 0.0f, 0.0f, 0.0f};
    style.Colors[ImGuiCol_ScrollbarGrab] = shade(kControl);
    style.Colors[ImGuiCol_ScrollbarGrabHovered] = shade(kControlHovered);
    style.Colors[ImGuiCol_ScrollbarGrabActive] = shade(kAccent);
}

Result<Type> load_type(const std::string& file, float scale, std::span<const std::uint32_t> letters) {
    std::vector<char> regular, medium;
    Type type;
    if (!file.empty()) {
        regular = medium = bytes_of_type(file);
        if (regular.empty())
            return fail(file, "is no TrueType or OpenType file", "name a .ttf or .otf file that can be read");
    }
    for (std::size_t i = 0; i < kKnownFiles.size() && regular.empty(); ++i) {
        regular = bytes_of_type(kKnownFiles[i].regular);
        medium = bytes_of_type(kKnownFiles[i].medium);
        if (i > 0 && !regular.empty()) type.notice = "Roboto is not installed, so the panel is set in DejaVu Sans";
    }
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
    atlas.TexDesiredWidth = 512;
    if (regular.empty()) {
        atlas.Clear();
        type.notice = "no type is installed, so the panel has the toolkit's own letters: install fonts-roboto-unhinted";
        add_own_letters(type, scale);
    } else {
        const std::string notice = type.notice;
        const TypeSource plain{regular, 0, ranges_of(letters, true)};
        const TypeSource strong{medium.empty() ? regular : medium, 0, plain.ranges};
        type = rasterise(plain, strong, nullptr, scale);
        std::vector<std::uint32_t> missing = missing_in(*type.text, letters);
        if (const auto other = type_with(missing)) {
            const TypeSource fallback{bytes_of_type(other->file), other->index, ranges_of(missing, false)};
            if (!fallback.bytes.empty()) type = rasterise(plain, strong, &fallback, scale);
            missing = missing_in(*type.text, missing);
        }
        type.notice = notice;
        if (!missing.empty())
            type.notice = "no installed font has the letter " + as_utf8(missing.front()) +
                          ", which is shown as ?: install one of its script, such as fonts-noto-cjk for Chinese";
        return type;
    }
    atlas.Build();
    return type;
}

std::vector<std::uint32_t> letters_beyond_latin(std::string_view text) {
    std::vector<std::uint32_t> letters;
    for (std::size_t i = 0; i < text.size();) {
        const auto first = static_cast<unsigned char>(text[i]);
        const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
        std::uint32_t letter = length == 2 ? first & 0x1Fu : first & 0x0Fu;
        for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
            letter = letter << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
        if ((length == 2 || length == 3) && letter > 0xFF && letter <= 0xFFFF) letters.push_back(letter);
        i += length;
    }
    return letters;
}

renderer::PanelAtlas atlas_of_context() {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    const ImageSize size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    return {size, std::vector<std::uint8_t>(pixels, pixels + std::size_t{size.width} * size.height)};
}

}  // namespace burin::session::panel
