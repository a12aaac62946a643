// SPDX-License-Identifier: MIT
#include "base/assets.hpp"

#include "base/places.hpp"

#include <sys/auxv.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <system_error>

namespace burin {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kAssetsPrefix = "assets/";  // of a path as the repository's users write it

struct RoomOfAssets {
    const char* folder;
    std::array<const char*, 6> endings;  // a VRML world's settings lie beside it as .toml, so .wrl is first
};

const RoomOfAssets& room_of(AssetRoom room) {
    static constexpr std::array<RoomOfAssets, 8> kRooms{{
        {"worlds", {".wrl", ".toml", ".obj", ".stl", ".ply", ".off"}},
        {"workpieces", {".obj", ".stl", ".ply", ".off", ".burin"}},
        {"tools", {".obj", ".stl", ".ply", ".off"}},
        {"strokes", {".csv"}},
        {"sessions", {".txt", ".session"}},
        {"walls", {".toml"}},
        {"trackers", {".toml"}},
        {"devices", {".toml"}},
    }};
    return kRooms[static_cast<std::size_t>(room)];
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

fs::path program_folder() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) return program.parent_path();
    // Where /proc is not mounted, as in a bare chroot, the kernel still tells by which name it has started the program.
    const auto* const name = reinterpret_cast<const char*>(getauxval(AT_EXECFN));  // NOLINT(performance-no-int-to-ptr)
    return name == nullptr ? fs::path() : fs::canonical(name, failed).parent_path();
}

const char* asked_folder() { return std::getenv("BURIN_ASSETS"); }  // NOLINT(concurrency-mt-unsafe)

// Returns the file of a name in a room's folder, with one of the room's endings where it has none; else nothing.
fs::path in_folder(const fs::path& folder, const RoomOfAssets& room, std::string_view name) {
    const fs::path given = folder / fs::path(name);
    if (is_file(given)) return given;
    for (const char* ending : room.endings)
        if (ending != nullptr && is_file(given.string() + ending)) return given.string() + ending;
    return {};
}

}  // namespace

fs::path assets_folder() {
    if (const char* asked = asked_folder(); asked != nullptr && *asked != '\0') {
        std::error_code ignored;
        return is_folder(asked) ? fs::absolute(asked, ignored) : fs::path();
    }
    const fs::path program = program_folder();
    for (const fs::path& folder :
         {program.parent_path() / "share/burin", program / "assets", program.parent_path() / "assets"})
        if (is_folder(folder / room_of(AssetRoom::worlds).folder)) return folder;
    return {};
}

std::string assets_line() {
    const fs::path folder = assets_folder();
    const char* const asked = asked_folder();
    if (asked != nullptr && *asked != '\0')
        return folder.empty() ? "BURIN_ASSETS names " + std::string(asked) + ", which is no folder"
                              : folder.string() + " (by BURIN_ASSETS)";
    if (folder.empty())
        return "none in " + (program_folder().parent_path() / "share/burin").string() +
               ": set BURIN_ASSETS to the folder that holds worlds/";
    return folder.string();
}

std::string asset_path(std::string_view file) {
    const fs::path here = fs::path(kAssetsPrefix) / fs::path(file), folder = assets_folder();
    if (folder.empty()) return here.string();
    std::error_code failed;
    if (fs::equivalent(here, folder / fs::path(file), failed) && !failed) return here.string();
    return (folder / fs::path(file)).string();
}

std::string asset_named(AssetRoom room, std::string_view name) {
    if (name.empty()) return {};
    if (is_file(fs::path(name))) return std::string(name);
    const fs::path folder = assets_folder();
    if (folder.empty() || fs::path(name).is_absolute()) return {};
    if (name.starts_with(kAssetsPrefix)) {
        const fs::path file = folder / fs::path(name.substr(kAssetsPrefix.size()));
        return is_file(file) ? file.string() : std::string();
    }
    if (name.starts_with('.')) return {};
    const RoomOfAssets& known = room_of(room);
    const fs::path found = in_folder(folder / known.folder, known, name);
    if (found.empty()) return {};
    return asset_path(found.lexically_relative(folder).string());
}

std::vector<std::string> asset_names(AssetRoom room) {
    const RoomOfAssets& known = room_of(room);
    std::vector<std::string> names;
    for (const fs::path& file : entries_of(assets_folder() / known.folder).value_or(std::vector<fs::path>())) {
        const std::string ending = file.extension().string();
        const auto is_known = [&](const char* one) { return one != nullptr && ending == one; };
        if (std::ranges::any_of(known.endings, is_known) && is_file(file)) names.push_back(file.stem().string());
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

const char* room_folder(AssetRoom room) { return room_of(room).folder; }

}  // namespace burin
