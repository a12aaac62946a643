// SPDX-License-Identifier: MIT
#include "session/record/log_outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/try.hpp"
#include "document/document_file.hpp"
#include "geometry/files/mesh_import.hpp"
#include "session/activity/activity.hpp"
#include "session/held/held_tool.hpp"
#include "session/input/command_input.hpp"
#include "session/input/input_event.hpp"
#include "session/input/input_words.hpp"
#include "session/options/session_setup.hpp"
#include "session/record/input_files.hpp"
#include "session/record/input_log.hpp"
#include "session/state/command_table.hpp"
#include "session/state/session_command.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStayBelow = "name it relative to the session's --outputs folder, such as ";

const char* example_of(OutputKind kind) {
    constexpr std::array kExamples{"cut.png", "part.stl", "bust.burin"};
    return kExamples.at(static_cast<std::size_t>(kind));
}

bool has_extension_of(const fs::path& name, OutputKind kind) {
    if (kind == OutputKind::picture) return name.extension() == ".png";
    if (kind == OutputKind::document) return document::is_document_name(name.string());
    const auto format = geometry::mesh_format_of(name);
    return format && *format != geometry::MeshFormat::off;
}

bool lies_in(const fs::path& place, const fs::path& folder) {
    return std::ranges::mismatch(folder, place).in1 == folder.end();
}

// Follows what is there already of a name below a canonical folder; the rest stands in the place as it is in the name.
Result<fs::path> followed(const fs::path& folder, const std::string& name) {
    fs::path place = folder;
    for (const fs::path& part : fs::path(name)) {
        place /= part;
        std::error_code failed;
        if (!fs::is_symlink(fs::symlink_status(place, failed))) continue;
        const fs::path target = fs::canonical(place, failed);
        if (failed) return fail(place.string(), "is a symbolic link to nothing", "remove the link");
        if (!lies_in(target, folder)) {
            return fail(place.string(), "is a symbolic link that leads out of the log's folder",
                        "remove the link, or give another --outputs folder");
        }
        place = target;
    }
    return place;
}

struct AskedFile {
    std::string name;
    OutputKind kind = OutputKind::picture;
};

// Returns the file that a command names.
std::optional<AskedFile> file_of(const SessionCommand& command) {
    if (const auto* mesh = std::get_if<ExportTo>(&command)) return AskedFile{mesh->path, OutputKind::mesh};
    const auto* saved = std::get_if<SaveTo>(&command);
    if (saved != nullptr && !saved->path.empty()) return AskedFile{saved->path, OutputKind::document};
    if (const auto* picture = std::get_if<ScreenshotTo>(&command)) return AskedFile{picture->path, OutputKind::picture};
    return std::nullopt;
}

std::optional<AskedFile> file_of(const InputEvent& event) {
    const auto* input = std::get_if<CommandInput>(&event.input);
    if (input == nullptr) return std::nullopt;
    const Result<SessionCommand> command = parse_command(*input);
    return command ? file_of(*command) : std::nullopt;
}

// Names the log's line in an error.
std::unexpected<Error> on_line(Error error, const std::string& log, std::size_t line) {
    error.where = log + ":" + std::to_string(line) + (error.where.empty() ? "" : ": " + error.where);
    return std::unexpected(std::move(error));
}

// Returns the state of a session that was started without options: a command that cannot be carried out there cannot
// be anywhere.
Result<SessionState> plain_state() {
    BURIN_TRY(tool, toolbox::parse_tool_settings({}));
    BURIN_TRY(feel, toolbox::parse_feel_settings({}));
    SessionState state;
    state.led().tool = tool;
    state.feel = feel;
    return state;
}

// Returns the tool that a command takes up.
std::optional<toolbox::ToolSpec> tool_in(const CommandInput& input) {
    const Result<SessionCommand> command = parse_command(input);
    if (!command) return std::nullopt;
    const auto* set = std::get_if<SetTool>(&*command);
    return set != nullptr ? std::optional(set->tool) : std::nullopt;
}

bool is_for_a_picture(const CommandInput& input) {
    const Result<SessionCommand> command = parse_command(input);
    if (!command) return false;
    const auto* run = std::get_if<RunAction>(&*command);
    return std::holds_alternative<ScreenshotTo>(*command) || (run != nullptr && run->action == Action::take_screenshot);
}

Result<void> check_command(const CommandInput& input, SessionState state, const Activity* activity) {
    BURIN_TRY(command, parse_command(input));
    if (const auto file = file_of(command)) {
        BURIN_TRY_DO(check_output_name(file->name, file->kind));
    }
    if (std::holds_alternative<EditObject>(command) || std::holds_alternative<SelectObject>(command) ||
        std::holds_alternative<LeadHand>(command) || std::holds_alternative<CalibrateHandle>(command))
        return {};  // which objects there are is not known yet, nor which device
    if (const auto* act = std::get_if<DoAct>(&command)) return check_act(activity, act->words);
    if (is_of_a_viewer(command)) return {};
    SessionOrders ignored;
    return run_command(state, ignored, command);
}

}  // namespace

Result<void> check_output_name(const std::string& name, OutputKind kind) {
    const fs::path path = name;
    const std::string where = as_word(name);
    const std::string below = kStayBelow + std::string(example_of(kind));
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (path.is_absolute()) return fail(where, "is an absolute path, and a log has its files in one folder", below);
    if (std::ranges::find(path, "..") != path.end())
        return fail(where, "leads up by \"..\", and a log has its files in one folder", below);
    if (std::ranges::any_of(name, control)) return fail(where, "holds control characters", below);
    if (has_extension_of(path, kind)) return {};
    if (kind == OutputKind::picture) return fail(where, "is no name of a picture", "name it .png");
    if (kind == OutputKind::document) return fail(where, "is no name of a document", "name it .burin");
    return fail(where, "has no extension that Burin exports", "name it .stl, .ply or .obj");
}

LogNeeds needs_of(std::span<const InputEvent> events) {
    LogNeeds needs;
    for (const InputEvent& event : events) {
        const auto* command = std::get_if<CommandInput>(&event.input);
        if (command != nullptr && is_for_a_picture(*command)) needs.pictures = true;
        const bool passes_by =
            command != nullptr || std::holds_alternative<HeadInput>(event.input) ||
            std::holds_alternative<FrameStart>(event.input) || std::holds_alternative<WindowResize>(event.input) ||
            std::holds_alternative<WindowFocus>(event.input) || std::holds_alternative<WindowClose>(event.input);
        if (!passes_by) needs.panel = true;
    }
    needs.panel = needs.panel || needs.pictures;
    return needs;
}

std::vector<toolbox::ToolSpec> tools_in(const InputLog& log) {
    std::vector<toolbox::ToolSpec> tools;
    for (const InputEvent& event : log.events)
        if (const auto* command = std::get_if<CommandInput>(&event.input))
            if (const auto tool = tool_in(*command)) tools.push_back(*tool);
    return tools;
}

Result<void> check_commands(const InputLog& log, const std::string& name, const Activity* activity) {
    BURIN_TRY(state, plain_state());
    auto meshes = std::make_shared<ToolMeshes>();
    state.meshes = meshes;
    std::vector<Error> wrong;
    for (const InputEvent& event : log.events) {
        const auto* command = std::get_if<CommandInput>(&event.input);
        if (command == nullptr) continue;
        Result<void> ok;
        if (const auto tool = tool_in(*command))
            if (const auto read = meshes->read(*tool); !read) ok = std::unexpected(read.error());
        if (ok) ok = check_command(*command, state, activity);
        if (!ok) wrong.push_back(on_line(ok.error(), name, event.line).error());
    }
    if (wrong.empty()) return {};
    if (wrong.size() == 1) return std::unexpected(wrong.front());
    for (const Error& one : wrong) std::fprintf(stderr, "burin: %s\n", one.line().c_str());
    return fail(name, std::to_string(wrong.size()) + " mistakes", "correct them; they are listed above");
}

// ---- Places

SessionOutputs::SessionOutputs(const SessionSetup& setup, std::vector<std::string> inputs)
    : refuses_meshes_(setup.work.refuses_exports), inputs_(std::move(inputs)) {
    if (setup.work.writes_nothing) {
        rule_ = Rule::nothing;
    } else if (!setup.record.input.empty()) {
        rule_ = Rule::in_folder;
        const bool named = !setup.work.outputs.empty();
        meshes_ = {named ? setup.work.outputs : fs::path(setup.record.input).stem().string() + "-outputs", "--outputs",
                   named};
        pictures_ = setup.desk.screenshots.empty() ? meshes_ : Folder{setup.desk.screenshots, "--screenshots", true};
    } else {
        pictures_.path = setup.desk.screenshots;
    }
}

Result<void> SessionOutputs::make(const Folder& folder) {
    std::error_code failed;
    if (!folder.may_be_link && fs::is_symlink(fs::symlink_status(folder.path, failed))) {
        return fail(folder.path.string(), "is a symbolic link, and nobody has named it as the folder of a log's files",
                    "remove the link, or give " + folder.option + " with a folder of your choice");
    }
    BURIN_TRY_DO(check_working_folder(folder.path));
    fs::create_directories(folder.path, failed);
    std::error_code ignored;
    if (!fs::is_directory(folder.path, ignored)) {
        return fail(folder.path.string(), "cannot be made as the folder of a log's files (" + failed.message() + ")",
                    "give another " + folder.option + " folder");
    }
    if (::access(folder.path.c_str(), W_OK | X_OK) == 0) return {};
    return fail(folder.path.string(), "no file can be made in this folder of a log's files",
                "give another " + folder.option + " folder");
}

Result<void> SessionOutputs::prepare(const InputLog& log, const std::string& name) const {
    if (rule_ != Rule::in_folder) return {};
    for (const InputEvent& event : log.events) {
        const auto file = file_of(event);
        if (!file) continue;
        const Result<fs::path> place = place_of(file->name, file->kind);
        if (!place) return on_line(place.error(), name, event.line);
        if (const auto ok = check_writable(*place); !ok) return on_line(ok.error(), name, event.line);
    }
    return {};
}

Result<fs::path> SessionOutputs::place_of(const std::string& name, OutputKind kind) const {
    if (kind != OutputKind::picture && refuses_meshes_)
        return fail(as_word(name),
                    kind == OutputKind::mesh ? "is not exported by a replay that compares"
                                             : "is not saved by a replay that compares",
                    "replay it by --input to have it written");
    Result<fs::path> place = place_in_folder(name, kind);
    if (!place) return place;
    for (const std::string& input : inputs_)
        if (is_same_file(*place, input))
            return fail(as_word(name), "is a file that this session reads, and would be overwritten",
                        "choose another name");
    return place;
}

Result<fs::path> SessionOutputs::new_place_of(const std::string& name, OutputKind kind) {
    Result<fs::path> place = place_of(name, kind);
    if (!place || rule_ != Rule::anywhere) return place;
    std::error_code ignored;
    const fs::path asked = *place;
    const auto taken = [&](const fs::path& p) { return fs::exists(p, ignored) || promised_.contains(p); };
    for (int number = 2; taken(*place); ++number) {
        *place = asked;
        place->replace_filename(asked.stem().string() + "-" + std::to_string(number) + asked.extension().string());
    }
    promised_.insert(*place);
    return place;
}

Result<fs::path> SessionOutputs::place_in_folder(const std::string& name, OutputKind kind) const {
    const Folder& folder = kind == OutputKind::picture ? pictures_ : meshes_;
    if (rule_ != Rule::in_folder) return folder.path / name;
    BURIN_TRY_DO(check_output_name(name, kind));
    BURIN_TRY_DO(make(folder));
    std::error_code failed;
    const fs::path root = fs::canonical(folder.path, failed);
    if (failed) return fail(folder.path.string(), "cannot be found: " + failed.message(), "give another folder");
    const Result<fs::path> place = followed(root, name);
    if (!place) return place;
    fs::create_directories(place->parent_path(), failed);
    if (failed) {
        return fail(place->parent_path().string(), "cannot be made as a folder: " + failed.message(),
                    "choose another name");
    }
    return folder.path / place->lexically_relative(root);
}

}  // namespace burin::session
