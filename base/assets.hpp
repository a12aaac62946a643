// SPDX-License-Identifier: MIT
// Where the files that come with the program lie: worlds, workpieces, tools, strokes, sessions, walls, trackers and
// devices, each kind in a room (a folder) of its own. The folder is, by this order:
//   BURIN_ASSETS              the environment's variable, where it is set
//   PREFIX/share/burin        of a program that is installed as PREFIX/bin/burin
//   assets beside it          of a program in its build folder, or in the folder below it, as tests are
// So a program that is installed and one that is built each find their own, whatever the working folder is.
//
// Threads: any, as long as none changes the environment. Failure: what is not found has an empty path, or keeps its
// name, and who opens it tells so. Cost: looks at a few names in the file system; never called from the haptic thread.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

// Returns the folder; an empty path where there is none.
[[nodiscard]] std::filesystem::path assets_folder();
// Returns one sentence that says where the folder is, or why there is none and what to do.
[[nodiscard]] std::string assets_line();

// Returns the path of a file of the assets, which is named by its room and its name. Where the working folder holds
// these very assets as assets/, the path is relative, as users of the repository write it.
[[nodiscard]] std::string asset_path(std::string_view file);

// Rooms, and by which endings a name without one is completed there, the first that exists.
enum class AssetRoom { worlds, workpieces, tools, strokes, sessions, walls, trackers, devices };
inline constexpr std::array kAssetRooms{AssetRoom::worlds,   AssetRoom::workpieces, AssetRoom::tools,
                                        AssetRoom::strokes,  AssetRoom::sessions,   AssetRoom::walls,
                                        AssetRoom::trackers, AssetRoom::devices};

// Returns the path of what a user has named: a file that exists as it is; else assets/ROOM/FILE by that path, FILE of
// the room, or FILE by its name without the ending ("garden"). Returns an empty text where nothing of these exists.
[[nodiscard]] std::string asset_named(AssetRoom room, std::string_view name);

// Returns the names that asset_named() knows in a room, sorted, without endings.
[[nodiscard]] std::vector<std::string> asset_names(AssetRoom room);
[[nodiscard]] const char* room_folder(AssetRoom room);  // "worlds"

}  // namespace burin
