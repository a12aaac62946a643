// SPDX-License-Identifier: MIT
// Decides what the commands of a log may write. A script or a recording can come from anybody; so its files go below
// one folder, that the session's user names, and are pictures, meshes and documents alone.
//
//   names     relative, without "..", with the extension of a picture, mesh or document: check_output_name()
//   commands  all that a log holds are checked before its session begins: check_commands()
//   places    no symbolic link leads out of the folder; looked at right before a file is written: SessionOutputs
//   inputs    nobody's file takes the place of one that the session reads: SessionOutputs
//
// Else a user at keys and panel writes wherever the system lets them: names are taken as they are, with a number where
// a file has the name already, since a key asks nobody whether that file may go. Failure: an Error that names the file
// and the remedy; check_commands() names the log's line as well. One thread.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace burin::toolbox {
struct ToolSpec;  // toolbox/tool_kinds.hpp
}  // namespace burin::toolbox

namespace burin::session {

class Activity;       // session/activity/activity.hpp
struct InputEvent;    // session/input/input_event.hpp
struct InputLog;      // session/record/input_log.hpp
struct SessionSetup;  // session/options/session_setup.hpp

enum class OutputKind : std::uint8_t { picture, mesh, document };

// Checks a file name that a log gives; looks at no file.
[[nodiscard]] Result<void> check_output_name(const std::string& name, OutputKind kind);

// Checks all commands of a log: that they are known, that their arguments make sense, and that a session of whatever
// state could carry them out; of the activity, null for none, that it has such acts. name: the log's file name.
[[nodiscard]] Result<void> check_commands(const InputLog& log, const std::string& name,
                                          const Activity* activity = nullptr);

// What a log's session needs besides its scene, where nobody sees it.
struct LogNeeds {
    bool pictures = false;  // commands ask for some
    // Mouse, keys or a tracked wand may meet the panel, or pictures show it.
    bool panel = false;
};
[[nodiscard]] LogNeeds needs_of(std::span<const InputEvent> events);

// Returns the tools that a log's commands take up.
[[nodiscard]] std::vector<toolbox::ToolSpec> tools_in(const InputLog& log);

// Places the files that a session is asked for. What is asked for in a log's session is the log's doing, by whatever
// way: keys, the panel and the mouse on it are events of the log.
class SessionOutputs {
public:
    // inputs: files of the session, none of which is overwritten (session/record/input_files.hpp).
    explicit SessionOutputs(const SessionSetup& setup, std::vector<std::string> inputs = {});

    // Returns whether files are written at all.
    [[nodiscard]] bool write() const { return rule_ != Rule::nothing; }
    // Returns whether they are a log's, below one folder, where a file takes the place of the run's before.
    [[nodiscard]] bool are_of_log() const { return rule_ == Rule::in_folder; }
    // Returns whether meshes and documents are refused, whatever they are called (WorkSetup::refuses_exports).
    [[nodiscard]] bool refuse_meshes() const { return refuses_meshes_; }
    // Makes the folders that the log's commands need, and checks that files can be written there.
    [[nodiscard]] Result<void> prepare(const InputLog& log, const std::string& name) const;
    // Returns where a file of this name goes. Makes the folders on its way. Fails where an input is there.
    [[nodiscard]] Result<std::filesystem::path> place_of(const std::string& name, OutputKind kind) const;
    // The same for a file that is about to be written: a user's gets a place that neither a file has nor one that was
    // placed before, such as part-2.stl; a log's is as it was in the run before.
    [[nodiscard]] Result<std::filesystem::path> new_place_of(const std::string& name, OutputKind kind);
    // Returns what a message calls the file: a log's by its name, so that pictures of the panel do not depend on the
    // folder.
    [[nodiscard]] std::string shown(const std::string& name, const std::filesystem::path& place) const {
        std::error_code ignored;
        return rule_ == Rule::in_folder ? name : std::filesystem::absolute(place, ignored).string();
    }

private:
    enum class Rule : std::uint8_t { anywhere, in_folder, nothing };
    struct Folder {
        std::filesystem::path path;
        std::string option;        // that names it
        bool may_be_link = false;  // the user has named it, and so knows where it leads
    };
    [[nodiscard]] static Result<void> make(const Folder& folder);
    [[nodiscard]] Result<std::filesystem::path> place_in_folder(const std::string& name, OutputKind kind) const;

    Rule rule_ = Rule::anywhere;
    Folder pictures_, meshes_;
    bool refuses_meshes_ = false;
    std::vector<std::string> inputs_;
    std::set<std::filesystem::path> promised_;  // to files of this session, which may not be written yet
};

}  // namespace burin::session
