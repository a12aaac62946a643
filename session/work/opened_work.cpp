// SPDX-License-Identifier: MIT
#include "session/work/opened_work.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/longest_side.hpp"
#include "base/numbers.hpp"
#include "base/try.hpp"
#include "compute/rays/extent.hpp"
#include "document/journal.hpp"
#include "document/log_check.hpp"
#include "record/store_reading.hpp"
#include "scene/saved_objects.hpp"
#include "session/held/held_tool.hpp"
#include "session/input/input_words.hpp"
#include "session/state/command_table.hpp"
#include "session/state/session_settings.hpp"
#include "session/work/opened_history.hpp"
#include "workpiece/saved_changes.hpp"
#include "workpiece/saved_solid.hpp"

namespace burin::session {
namespace {

constexpr const char *kUnit = "unit", *kBounds = "workpiece bounds m", *kView = "view", *kSource = "source",
                     *kSettings = "settings", *kHardness = "hardness", *kYield = "yield kPa", *kGrain = "grain mm";

// Writes numbers so that they read back to the same bits.
std::string exact(std::span<const double> numbers) {
    std::string text;
    for (const double number : numbers) {
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
        text += (text.empty() ? "" : ",") + std::string(digits.data(), end.ptr);
    }
    return text;
}

// What is seen of a workpiece, and from where, lies within these by far.
constexpr double kSmallestSeen_m = 1e-9, kLargestSeen_m = 1e9, kFarthestSeen_m = 1e12, kTurnTolerance = 1e-3;

void add_to(std::string& told, const std::string& more) { told += (told.empty() ? "" : "; ") + more; }

// Returns the saved view of a workpiece of this size; nothing where none was saved, or it is damaged, which is told.
std::optional<Similarity> view_in(const document::DocumentReader& reader, double size_m, std::string& lost) {
    if (!reader.facts().contains(kView)) return std::nullopt;
    const auto n = parse_numbers(reader.fact(kView), 8, kView);
    const auto is_near = [](double at_m) { return std::abs(at_m) <= kFarthestSeen_m; };
    const auto is_sound = [&] {
        const double turn = glm::length(Quat((*n)[3], (*n)[4], (*n)[5], (*n)[6])), seen_m = (*n)[7] * size_m;
        return std::ranges::all_of(std::span(*n).first(3), is_near) && std::abs(turn - 1.0) <= kTurnTolerance &&
               seen_m >= kSmallestSeen_m && seen_m <= kLargestSeen_m;
    };
    if (n && is_sound()) return Similarity{{(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5], (*n)[6]}, (*n)[7]};
    add_to(lost, "its view is damaged: it is seen as new work is");
    return std::nullopt;
}

// Returns the saved bounds of the workpiece, which lie in the lattice; where they are damaged, which is told, the
// lattice's.
Box bounds_in(const document::DocumentReader& reader, const compute::Lattice& lattice, std::string& lost) {
    if (!reader.facts().contains(kBounds)) return workpiece::workpiece_bounds(lattice);
    const auto n = parse_numbers(reader.fact(kBounds), 6, kBounds);
    const Box most = workpiece::lattice_bounds(lattice);
    const auto is_sound = [&] {
        double longest_m = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double lo = (*n)[static_cast<std::size_t>(axis)], hi = (*n)[static_cast<std::size_t>(axis) + 3];
            if (!(most.lo[axis] <= lo && lo <= hi && hi <= most.hi[axis])) return false;
            longest_m = std::max(longest_m, hi - lo);
        }
        return longest_m >= lattice.spacing_m;
    };
    if (n && is_sound()) return {{(*n)[0], (*n)[1], (*n)[2]}, {(*n)[3], (*n)[4], (*n)[5]}};
    add_to(lost, "the workpiece's bounds are damaged: those of its lattice are taken");
    return workpiece::workpiece_bounds(lattice);
}

// Makes a change of one part again; of the solid with a history of it, where there is one.
Result<void> apply_change(const scene::Pages& change, OpenedWork& opened, const std::string& where,
                          compute::History* history) {
    if (change.part == scene::kObjectsPart)
        return opened.world ? scene::apply_change(opened.world->objects, opened.colours, change, where)
                            : Result<void>{};
    return opened.workpiece ? workpiece::apply_change(opened.workpiece->solid, change, where, history) : Result<void>{};
}

// Has the order of steps follow a change. What the change says of the order may lack strokes that were noted before it.
void follow_change(const std::optional<document::History>& ordered, compute::History* history,
                   document::History& order) {
    constexpr std::uint32_t kPart = SessionState::kWorkpiecePart;
    if (ordered) order.replace_order(*ordered);
    if (history == nullptr) return;
    if (!ordered) return order.follow(kPart, steps_of(*history));
    if (!order.leads_forward(kPart)) history->forget_undone();
    order.adopt(kPart, steps_of(*history));
}

// Makes the changes again that were not saved. Stops, and fails, at one that is damaged. order: of the steps; null: it
// is not wanted.
Result<void> apply_changes(document::DocumentReader& reader, OpenedWork& opened, compute::History* history,
                           document::History* order) {
    for (std::int64_t number = 1; number <= reader.changes(); ++number) {
        BURIN_TRY(ordered, reader.history_after(number));
        bool is_there = ordered.has_value();
        for (const document::PartPlace& part : reader.parts()) {
            BURIN_TRY(change, reader.change(part, number));
            if (change.pages.empty()) continue;
            is_there = true;
            BURIN_TRY_DO(apply_change(change, opened, reader.path(), history));
        }
        if (!is_there) return fail(reader.path(), "change " + std::to_string(number) + " is missing");
        if (order != nullptr) follow_change(ordered, history, *order);
        opened.recovered = std::to_string(number) + (number == 1 ? " change" : " changes");
    }
    return {};
}

// Work from a journal goes where the work went that it is of.
void say_where_it_goes(const document::DocumentReader& reader, OpenedWork& opened) {
    const auto& facts = reader.facts();
    if (!facts.contains(document::kJournalNameFact)) {
        opened.document = reader.path();
        opened.version = reader.version();
        return;
    }
    opened.journal = reader.path();
    opened.name = reader.fact(document::kJournalNameFact);
    opened.recovered = "what was not saved has come back from " + reader.path() +
                       (opened.recovered.empty() ? std::string() : ": " + opened.recovered);
    const std::string of = reader.fact(document::kJournalOfFact);
    if (of.empty()) return;
    opened.document = of;
    opened.version = document::Version{reader.fact(document::kBaseIdFact), reader.number(document::kBaseSavesFact)};
}

// Takes the history of the solid that the pages hold. What is damaged and was made again is other than the strokes left
// it: nothing leads back from there.
void take_history(document::DocumentReader& reader, OpenedWork& opened, std::size_t undo_bytes, std::string& lost) {
    const auto part = std::ranges::find(reader.parts(), workpiece::kSolidPart, &document::PartPlace::kind);
    if (lost.empty()) {
        opened.history = history_in(reader, *part, opened.workpiece->solid, undo_bytes, lost);
        return;
    }
    opened.history.emplace(undo_bytes);
    const auto steps = reader.steps(*part);
    const bool had_some = !steps || (*steps && (*steps)->first <= (*steps)->last) || reader.changes() > 0;
    if (had_some) add_to(lost, "undo goes back to this opening alone");
}

bool has_part(const document::DocumentReader& reader, std::string_view kind) {
    return std::ranges::find(reader.parts(), kind, &document::PartPlace::kind) != reader.parts().end();
}

// Reads the solid and what led to it.
Result<void> read_solid(document::DocumentReader& reader, std::size_t undo_bytes, OpenedWork& opened,
                        std::string& lost) {
    BURIN_TRY(pages, reader.pages_of(workpiece::kSolidPart));
    BURIN_TRY(loaded, workpiece::load_solid(pages, reader.path()));
    opened.workpiece = {.solid = std::move(loaded.solid), .report = {}};
    lost = loaded.lost;
    if (undo_bytes > 0) take_history(reader, opened, undo_bytes, lost);
    return {};
}

Result<void> read_objects(document::DocumentReader& reader, OpenedWork& opened, std::string& lost) {
    BURIN_TRY(pages, reader.pages_of(scene::kObjectsPart));
    BURIN_TRY(loaded, scene::load_objects(pages, reader.path()));
    opened.world = {std::filesystem::path(reader.path()).stem().string(), std::move(loaded.objects), {}};
    opened.colours = std::move(loaded.colours);
    if (!loaded.lost.empty()) add_to(lost, loaded.lost);
    return {};
}

// Says of the workpiece what the document knows of it.
void describe_workpiece(const document::DocumentReader& reader, workpiece::LoadedWorkpiece& workpiece,
                        std::string& lost) {
    const std::string& path = reader.path();
    workpiece.unit = length_unit(reader.fact(kUnit)).value_or(LengthUnit::m);
    workpiece.bounds_object = bounds_in(reader, workpiece.solid.lattice, lost);
    // Of what is there now; the bounds are where the view was framed.
    const Box material = compute::material_bounds(workpiece.solid);
    workpiece.size_m = material.empty() ? Vec3(0.0) : material.extent();
    const std::string size = material.empty() ? "nothing is left" : in_millimetres(workpiece.size_m);
    workpiece.size = path + ": " + size + ", saved from " + reader.fact(kSource);
    workpiece.report = {{"source", path}, {"size", workpiece.size}, {"made_from", reader.fact(kSource)}};
}

std::string number_in(double value) { return exact(std::array{value}); }

constexpr const char* kCannotBeCut = "inf";  // a hardness that no command sets

// Puts what a command sets into the options; commands that set something else change nothing.
struct IntoOptions {
    SessionSetup& options;
    bool keeps_tool, keeps_hardness;  // that the options have

    void operator()(const SetTool& set) const {
        if (keeps_tool) return;
        const std::string shape = toolbox::text_of(set.tool);
        if (const auto read = ToolMeshes().read(set.tool); read)
            options.hands.tool.shape = shape;
        else  // its file lies elsewhere now; the work is no less there
            std::fprintf(stderr, "burin: %s: its tool %s cannot be taken up, the usual one is: %s\n",
                         document_of(options).c_str(), shape.c_str(), read.error().line().c_str());
    }
    void operator()(const SetOperation& set) const {
        if (!keeps_tool) options.hands.tool.operation = set.operation;
    }
    void operator()(const SetColour& set) const {
        if (keeps_tool || !options.hands.tool.material.empty()) return;
        std::array<double, 3> of_255{};  // as --material has it
        for (std::size_t k = 0; k < 3; ++k) of_255[k] = std::round(255.0 * std::clamp(set.srgb[k], 0.0, 1.0));
        options.hands.tool.material = exact(of_255);
    }
    void operator()(const SetMaterial& set) const {
        if (!keeps_hardness)
            options.carve.feel.hardness = toolbox::feel_presets()[static_cast<std::size_t>(set.preset)].name;
    }
    void operator()(const SetQuantity& set) const {
        if (set.quantity == Quantity::hardness && !keeps_hardness)
            options.carve.feel.hardness = number_in(set.value / toolbox::kHardnessUnit_Ns_per_m3);
        if (set.quantity == Quantity::stiffness && !options.carve.feel.stiffness_N_per_m)
            options.carve.feel.stiffness_N_per_m = set.value;
        if (set.quantity == Quantity::friction && !options.carve.feel.friction) options.carve.feel.friction = set.value;
    }
    void operator()(const SetMirror& set) const {
        if (!options.carve.mirror.any()) options.carve.mirror = set.mirror;
    }
    void operator()(const auto&) const {}
};

// Takes what of the material's feel no command sets, where the options leave it open.
void take_feel(const document::DocumentReader& reader, bool keeps_hardness, toolbox::FeelOptions& feel) {
    const auto take = [&](const char* fact, std::optional<double>& into) {
        const auto number = parse_numbers(reader.fact(fact), 1, fact);
        if (number && !into) into = number->front();
    };
    take(kGrain, feel.grain_mm);
    if (keeps_hardness) return;
    take(kYield, feel.yield_kPa);
    if (reader.fact(kHardness) == kCannotBeCut) feel.hardness = kCannotBeCut;
}

std::string line_of(const SessionCommand& command) {
    const CommandInput input = as_input(command);
    std::string line = input.name;
    for (const std::string& argument : input.arguments) line += " " + as_word(argument);
    return line;
}

}  // namespace

bool is_document(const workpiece::WorkpieceOptions& options) { return document::is_document_name(options.source); }

std::string document_of(const SessionSetup& options) {
    if (!options.scene.no_workpiece && is_document(options.carve.workpiece)) return options.carve.workpiece.source;
    return document::is_document_name(options.scene.world) ? options.scene.world : std::string();
}

Result<void> settle_document(SessionSetup& options) {
    const std::string path = document_of(options);
    if (path.empty() || options.scene.given != nullptr) return {};
    BURIN_TRY(reader, document::DocumentReader::open(path));
    const bool has_solid = has_part(reader, workpiece::kSolidPart), has_objects = has_part(reader, scene::kObjectsPart);
    if (!has_solid && !has_objects)
        return fail(path, "holds neither a workpiece nor a world", "open it with the program that has saved it");
    const bool brings_other = (has_objects && !options.scene.world.empty() && options.scene.world != path) ||
                              (has_solid && !options.scene.no_workpiece && options.carve.workpiece.source != path);
    if (brings_other)
        return fail(path,
                    "brings its own " + std::string(has_objects && options.scene.world != path ? "world" : "workpiece"),
                    "leave the other out");
    if (has_objects) options.scene.world = path;
    options.scene.no_workpiece = options.scene.no_workpiece && !has_solid;
    if (has_solid) options.carve.workpiece.source = path;
    if (!has_solid && options.carve.workpiece.source == path) options.scene.no_workpiece = true;
    return {};
}

namespace {

// Reads the order of the steps of solid and objects as the pages are.
document::History order_in(document::DocumentReader& reader, const compute::History* history, std::string& lost) {
    document::History order;
    Result<std::optional<document::History>> saved = reader.history();
    if (!saved) add_to(lost, "the order of its steps is damaged: undo takes back the edits of objects first");
    if (saved && *saved) order = std::move(**saved);
    if (history != nullptr) order.adopt(SessionState::kWorkpiecePart, steps_of(*history));
    return order;
}

// Reads what was done to the objects, as of the newest change: what the history names of it.
void take_edits(document::DocumentReader& reader, OpenedWork& opened, bool is_sound, std::string& lost) {
    const auto part = std::ranges::find(reader.parts(), scene::kObjectsPart, &document::PartPlace::kind);
    const std::uint32_t number = opened.workpiece ? 1 : 0;
    if (is_sound) {
        opened.edits = edits_in(reader, *part, opened.world->objects, opened.colours, lost);
    } else {
        const auto steps = reader.steps(*part);
        if (!steps || (*steps && (*steps)->first <= (*steps)->last))
            add_to(lost, "edits of objects are undone back to this opening alone");
    }
    if (!opened.order.leads_forward(number)) opened.edits.forget_undone();
    opened.order.adopt(number, opened.edits.steps());
}

}  // namespace

Result<OpenedWork> open_document(const std::string& path, std::size_t undo_bytes) {
    BURIN_TRY(reader, document::DocumentReader::open(path));
    OpenedWork opened;
    std::string lost;
    const bool has_objects = has_part(reader, scene::kObjectsPart);
    const bool has_solid = has_part(reader, workpiece::kSolidPart) || !has_objects;
    if (has_solid) BURIN_TRY_DO(read_solid(reader, undo_bytes, opened, lost));
    const bool leads_back = has_solid && undo_bytes > 0 && lost.empty();
    const std::size_t lost_before = lost.size();
    if (has_objects) BURIN_TRY_DO(read_objects(reader, opened, lost));
    const bool has_all_objects = lost.size() == lost_before;
    compute::History* const history = leads_back ? &*opened.history : nullptr;
    if (undo_bytes > 0) opened.order = order_in(reader, history, lost);
    const auto changed = apply_changes(reader, opened, history, undo_bytes > 0 ? &opened.order : nullptr);
    if (!changed) add_to(lost, changed.error().what);
    if (history != nullptr) history->take_step(compute::HistoryStep::stroke);  // the one that was not ended
    if (history != nullptr) opened.order.follow(SessionState::kWorkpiecePart, steps_of(*history));
    if (undo_bytes > 0 && has_objects) take_edits(reader, opened, has_all_objects && changed.has_value(), lost);
    if (document::is_log_damaged(path))
        add_to(lost, "its log " + path + "-wal is damaged: the newest changes may be missing");
    if (record::lacks_its_log(path))
        add_to(lost, "its log " + path + "-wal is not beside it: the newest changes may be missing");
    say_where_it_goes(reader, opened);
    double size_m = 1.0;
    if (opened.workpiece) {
        describe_workpiece(reader, *opened.workpiece, lost);
        size_m = longest_side_m(opened.workpiece->bounds_object);
    }
    opened.view = view_in(reader, size_m, lost);
    if (!lost.empty()) {
        opened.lost = path + ": " + lost;
        if (opened.workpiece) opened.workpiece->report["lost"] = lost;
    }
    for (const char* fact : {kSource, document::kSourceDigestFact, kSettings})
        if (reader.facts().contains(fact)) opened.origin[fact] = reader.fact(fact);
    return opened;
}

Result<OpenedWork> open_workpiece_of(const std::string& document, std::size_t undo_bytes) {
    Result<OpenedWork> opened = open_document(document, undo_bytes);
    if (!opened || opened->workpiece) return opened;
    return fail(document, "holds a world and no workpiece", "open it as one: burin world " + document);
}

Result<void> take_settings_of_document(SessionSetup& options) {
    const std::string path = document_of(options);
    if (path.empty()) return {};
    BURIN_TRY(reader, document::DocumentReader::open(path));
    const IntoOptions into{options, !options.hands.tool.shape.empty(),
                           options.carve.feel.hardness != toolbox::FeelOptions{}.hardness};
    // A command that this program does not know is left out: what it set is not there either.
    for (const std::string& line : reader.commands())
        if (const Result<SessionCommand> command = parse_command_line(line)) std::visit(into, *command);
    take_feel(reader, into.keeps_hardness, options.carve.feel);
    return {};
}

std::vector<std::string> saved_commands(const SessionState& state) {
    const toolbox::ToolSettings& tool = state.led().tool;
    std::vector<SessionCommand> commands{SetTool{tool.shape}, SetOperation{tool.operation}};
    if (tool.colour) {
        SetColour colour;
        for (std::size_t k = 0; k < 3; ++k) colour.srgb[k] = (*tool.colour)[k] / 255.0;
        commands.emplace_back(colour);
    }
    commands.emplace_back(SetMaterial{state.feel.preset});
    const auto add = [&](bool given, Quantity quantity) {
        if (given) commands.emplace_back(SetQuantity{quantity, descriptor_of(quantity).value(state)});
    };
    add(std::isfinite(state.feel.hardness_kPa_per_mm_s.value_or(HUGE_VAL)), Quantity::hardness);
    add(state.feel.friction.has_value(), Quantity::friction);
    add(state.feel.stiffness_N_per_m.has_value(), Quantity::stiffness);
    if (state.mirror.any()) commands.emplace_back(SetMirror{state.mirror});
    std::vector<std::string> lines;
    for (const SessionCommand& command : commands) lines.push_back(line_of(command));
    return lines;
}

std::map<std::string, std::string> saved_facts(const SessionSetup& options, const SessionState& state,
                                               const Box& workpiece_object) {
    std::map<std::string, std::string> facts(options.work.provenance.begin(), options.work.provenance.end());
    const Similarity& view = state.world_from_object;
    facts[kUnit] = name_of(state.export_unit);
    // Empty where there is none: a fact that is not written stays as it was.
    const toolbox::FeelSettings& feel = state.feel;
    facts[kHardness] = std::isinf(feel.hardness_kPa_per_mm_s.value_or(0.0)) ? kCannotBeCut : "";
    facts[kYield] = feel.yield_kPa ? number_in(*feel.yield_kPa) : "";
    facts[kGrain] = feel.grain_mm ? number_in(*feel.grain_mm) : "";
    if (!workpiece_object.empty())
        facts[kBounds] = exact(std::array{workpiece_object.lo.x, workpiece_object.lo.y, workpiece_object.lo.z,
                                          workpiece_object.hi.x, workpiece_object.hi.y, workpiece_object.hi.z});
    facts[kView] = exact(std::array{view.position_m.x, view.position_m.y, view.position_m.z, view.orientation.w,
                                    view.orientation.x, view.orientation.y, view.orientation.z, view.scale});
    if (!document_of(options).empty()) return facts;  // whose source is known already
    facts[kSource] = options.scene.no_workpiece ? options.scene.world : options.carve.workpiece.source;
    facts[kSettings] = settings_line(options);
    return facts;
}

}  // namespace burin::session
