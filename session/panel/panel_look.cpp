// SPDX-License-Identifier: MIT
#include "session/panel/panel_look.hpp"

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
    const bool known = head == std::string_view("\0\1\0\0", 4) || head == "OTTO" || head == "true";
    return known && bytes.size() > 1024 ? bytes : std::vector<char>{};
}

ImFont* add(const std::vector<char>& bytes, float size_px) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;  // letters lie between pixels across, not down
    config.PixelSnapH = false;
    // Latin 1 alone: all that the panel shows.
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<char*>(bytes.data()), static_cast<int>(bytes.size()),
                                                      std::round(size_px), &config);
}

void add_own_letters(Type& type, float scale) {
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale);
    type.text = type.small = type.strong = type.title = ImGui::GetIO().Fonts->AddFontDefault(&config);
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

Result<Type> load_type(const std::string& file, float scale) {
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
        type.notice = "no type is installed, so the panel has the toolkit's own letters: install fonts-roboto-unhinted";
        add_own_letters(type, scale);
    } else {
        const std::vector<char>& strong = medium.empty() ? regular : medium;
        type.text = add(regular, kText_px * scale);
        type.small = add(regular, kSmall_px * scale);
        type.strong = add(strong, kText_px * scale);
        type.title = add(strong, kTitle_px * scale);
    }
    atlas.Build();  // while the bytes exist
    return type;
}

renderer::PanelAtlas atlas_of_context() {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    const ImageSize size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    return {size, std::vector<std::uint8_t>(pixels, pixels + std::size_t{size.width} * size.height)};
}

}  // namespace burin::session::panel
