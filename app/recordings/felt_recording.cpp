// SPDX-License-Identifier: MIT
#include "app/recordings/felt_recording.hpp"

#include <filesystem>
#include <utility>

#include "base/file_io.hpp"
#include "base/json.hpp"
#include "base/temporary_folder.hpp"
#include "base/try.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "session/options/option_bounds.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

template <typename T>
Json optional_json(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

// Reads values by their keys, and notes the first that is missing or of another type.
class FeltReader {
public:
    explicit FeltReader(const Json& json) : json_(json) {}

    void text(const char* part, const char* key, std::string& to) {
        if (const Json* value = at(part, key); value != nullptr && value->is_string())
            to = value->get<std::string>();
        else
            note(key);
    }
    void flag(const char* part, const char* key, bool& to) {
        if (const Json* value = at(part, key); value != nullptr && value->is_boolean())
            to = value->get<bool>();
        else
            note(key);
    }
    template <typename T>
    void number(const char* part, const char* key, T& to, double least, double most) {
        const Json* value = at(part, key);
        if (value != nullptr && value->is_number() && value->get<double>() >= least && value->get<double>() <= most)
            to = value->get<T>();
        else
            note(key);
    }
    template <typename T, typename B>
    void number(const char* part, const char* key, T& to, const session::Bounds<B>& bounds) {
        number(part, key, to, static_cast<double>(bounds.least), static_cast<double>(bounds.most));
    }
    void maybe(const char* part, const char* key, std::optional<double>& to) {
        if (const Json* value = at(part, key); value != nullptr && value->is_null()) return;
        to.emplace();
        number(part, key, *to, -1e300, 1e300);
    }
    // Reads likewise a key that recordings of before do not have.
    void text_later(const char* part, const char* key, std::string& to) {
        if (at(part, key) != nullptr) text(part, key, to);
    }
    void maybe_later(const char* part, const char* key, std::optional<double>& to) {
        if (at(part, key) != nullptr) maybe(part, key, to);
    }
    [[nodiscard]] const std::string& missing() const { return missing_; }

private:
    [[nodiscard]] const Json* at(const char* part, const char* key) const {
        if (!json_.is_object() || !json_.contains(part) || !json_[part].is_object()) return nullptr;
        const auto found = json_[part].find(key);
        return found == json_[part].end() ? nullptr : &*found;
    }
    void note(const char* key) {
        if (missing_.empty()) missing_ = key;
    }
    const Json& json_;
    std::string missing_;
};

// Checks that a file is the one that was recorded. No digest was recorded of what is no file.
Result<void> check_same_file(const record::RecordReader& reader, const char* fact, const std::string& path,
                             const std::string& option) {
    const auto recorded = reader.facts().find(fact);
    if (recorded == reader.facts().end()) return {};
    const Result<std::string> now = file_digest(path);
    if (!now) return fail(now.error().where, now.error().what, "say where the recorded file is now by " + option);
    if (*now == recorded->second) return {};
    return fail(path,
                "is another file than the one that was recorded: SHA-256 " + *now + ", recorded: " + recorded->second,
                "name the recorded one by " + option);
}

}  // namespace

std::string felt_settings(const session::SessionSetup& options, const toolbox::ToolOptions& tool,
                          const std::string& engine) {
    const toolbox::FeelOptions& feel = options.carve.feel;
    const auto& units = options.carve.workpiece.units;
    const Json json{{"workpiece",
                     {{"source", options.carve.workpiece.source},
                      {"resolution", options.carve.workpiece.resolution},
                      {"close_holes", options.carve.workpiece.close_holes},
                      {"weld_m", optional_json(options.carve.workpiece.weld_m)},
                      {"room", optional_json(options.carve.workpiece.room)},
                      {"units", units ? std::string(name_of(*units)) : std::string()}}},
                    {"tool",
                     {{"shape", tool.shape},
                      {"operation", std::string(toolbox::descriptor_of(tool.operation).name)},
                      {"material", tool.material},
                      {"sweep_tolerance_cells", tool.sweep_tolerance_cells},
                      {"smooth_strength", tool.smooth_strength},
                      {"mirror", toolbox::name_of(options.carve.mirror)}}},
                    {"feel",
                     {{"hardness", feel.hardness},
                      {"yield_kPa", optional_json(feel.yield_kPa)},
                      {"grain_mm", optional_json(feel.grain_mm)},
                      {"stiffness_N_per_m", optional_json(feel.stiffness_N_per_m)},
                      {"friction", optional_json(feel.friction)},
                      {"press_N", feel.press_N},
                      {"grip_N_per_m", feel.grip_N_per_m}}},
                    {"session",
                     {{"stroke", options.carve.stroke.file},
                      {"engine", engine},
                      {"undo", options.carve.stroke.undo > 0},
                      {"real_time", options.carve.stroke.real_time}}}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<session::SessionSetup> read_felt_settings(const std::string& text, const std::string& where) {
    const Json json = Json::parse(text, nullptr, false);
    FeltReader reader(json);
    session::SessionSetup o;
    std::string units, operation, engine, mirror = "none";
    bool undo = false;
    reader.text("workpiece", "source", o.carve.workpiece.source);
    reader.number("workpiece", "resolution", o.carve.workpiece.resolution, session::kResolutionBounds);
    reader.flag("workpiece", "close_holes", o.carve.workpiece.close_holes);
    reader.maybe_later("workpiece", "weld_m", o.carve.workpiece.weld_m);
    reader.maybe_later("workpiece", "room", o.carve.workpiece.room);
    reader.text("workpiece", "units", units);
    reader.text("tool", "shape", o.hands.tool.shape);
    reader.text("tool", "operation", operation);
    reader.text("tool", "material", o.hands.tool.material);
    reader.number("tool", "sweep_tolerance_cells", o.hands.tool.sweep_tolerance_cells, session::kSweepToleranceBounds);
    reader.number("tool", "smooth_strength", o.hands.tool.smooth_strength, session::kSmoothStrengthBounds);
    reader.text_later("tool", "mirror", mirror);
    reader.text("feel", "hardness", o.carve.feel.hardness);
    reader.maybe("feel", "yield_kPa", o.carve.feel.yield_kPa);
    reader.maybe("feel", "grain_mm", o.carve.feel.grain_mm);
    reader.maybe("feel", "stiffness_N_per_m", o.carve.feel.stiffness_N_per_m);
    reader.maybe("feel", "friction", o.carve.feel.friction);
    reader.number("feel", "press_N", o.carve.feel.press_N, -1e300, 1e300);
    reader.number("feel", "grip_N_per_m", o.carve.feel.grip_N_per_m, -1e300, 1e300);
    reader.text("session", "stroke", o.carve.stroke.file);
    reader.text("session", "engine", engine);
    reader.flag("session", "undo", undo);
    reader.flag("session", "real_time", o.carve.stroke.real_time);
    BURIN_TRY(planes, toolbox::parse_mirror(mirror, where));
    o.carve.mirror = planes;
    if (!reader.missing().empty())
        return fail(where, "its settings have no sound value for " + reader.missing(),
                    "replay a recording that burin sculpt --hand simulated --record has written");
    o.carve.workpiece.units = length_unit(units);
    for (const toolbox::OperationDescriptor& known : toolbox::operations())
        if (known.name == operation) o.hands.tool.operation = known.operation;
    o.carve.engine = engine == "vulkan" ? compute::EngineChoice::vulkan : compute::EngineChoice::cpu;
    o.carve.stroke.undo = undo ? 1 : 0;
    o.carve.stroke.hand = session::HandChoice::simulated;
    return o;
}

std::optional<double> felt_ball_radius_m(const std::string& settings) {
    const auto options = read_felt_settings(settings, "");
    if (!options || !options->hands.tool.shape.starts_with("ball:")) return {};
    const auto tool = toolbox::parse_tool(options->hands.tool);
    if (!tool || !(tool->ball_radius_m() > 0.0)) return {};
    return tool->ball_radius_m();
}

Result<record::Comparison> replay_felt(record::RecordReader& reader, const FeltFiles& files,
                                       const record::TickRange& range) {
    const auto settings = reader.facts().find("settings");
    BURIN_TRY(options, read_felt_settings(settings == reader.facts().end() ? "" : settings->second, reader.path()));
    if (options.carve.stroke.real_time)
        return fail(reader.path(), "was felt in real time, and does not hold which tick saw which carving",
                    "replay a stroke that was felt in simulated time; the data can be read and converted");
    if (!files.stroke.empty()) options.carve.stroke.file = files.stroke;
    if (!files.workpiece.empty()) options.carve.workpiece.source = files.workpiece;
    if (files.engine) options.carve.engine = *files.engine;
    const std::string& shape = options.hands.tool.shape;
    const std::string tool_file = shape.starts_with("mesh:") ? shape.substr(5) : std::string();
    for (const auto& ok : {check_same_file(reader, "stroke sha256", options.carve.stroke.file, "--stroke"),
                           check_same_file(reader, "workpiece sha256", options.carve.workpiece.source, "--workpiece"),
                           check_same_file(reader, "tool sha256", tool_file, "putting it where it was")})
        if (!ok) return std::unexpected(ok.error());
    BURIN_TRY(folder, TemporaryFolder::create());
    options.record.path = folder / "again.session";
    BURIN_TRY_DO(record_again(options));
    BURIN_TRY(again, record::RecordReader::open(options.record.path));
    return record::compare(reader, again, {}, range);
}

}  // namespace burin::app
