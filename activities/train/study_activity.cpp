// SPDX-License-Identifier: MIT
#include "activities/train/study_activity.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "activities/train/stage_view.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;

// A wall of so little presses on nobody, and its contact is known all the same.
constexpr double kUnfelt_N_per_m = 1e-6;

constexpr std::array kStudyActs{
    session::Act{"start", "", "Begin the next stage"},
    session::Act{"next", "", "End the stage, where the protocol has the operator end it"},
    session::Act{"pause", "", "Hold the stage; an attempt under way is lost and not counted"},
    session::Act{"go-on", "", "Go on after a pause"},
    session::Act{"repeat", "", "Give the attempt up, and have it done again"},
    session::Act{"stop", "", "End the stage and the visit"},
    session::Act{"jig", "", "The wand stands in its jig: nothing goes on where it reads farther off than is allowed"},
    session::Act{"note", "TEXT...", "Write to the journal; it must name nobody"},
};

std::string joined_words(std::span<const std::string> words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

}  // namespace

StudyActivity::StudyActivity(const study::Protocol& protocol, const study::Group& group, const FeltWorlds& worlds,
                             std::vector<study::StagePlace> places, std::string settings, StudyDevice device,
                             StageKeeper keeper, std::vector<std::pair<std::string, std::string>> facts)
    : protocol_(protocol),
      group_(group),
      visit_(protocol, worlds, places),
      world_(visit_.worlds().front()),
      settings_(std::move(settings)),
      facts_(std::move(facts)),
      device_(std::move(device)),
      keeper_(std::move(keeper)),
      run_(protocol, group, worlds, std::move(places)) {
    if (device_.wand) device_.wand->calibration.tolerance_m = protocol.calibration_tolerance_m;
}

std::span<const session::Act> StudyActivity::acts() const { return kStudyActs; }

void StudyActivity::tell(const Result<void>& done, session::ActivityOrders& orders) {
    if (!done) orders.messages.push_back("NOT KEPT: " + done.error().line());
}

Result<void> StudyActivity::act(std::span<const std::string> words, session::ActivityOrders& orders) {
    if (words[0] == "jig") return check_jig(orders);
    const std::string text = words[0] == "go-on" ? "go on" : joined_words(words);
    BURIN_TRY(command, operator_command(text));
    if (const auto ok = check_order(command); !ok) return fail("do " + words[0], ok.error().what, ok.error().remedy);
    if (command.says == OperatorSays::start) {
        // On a busy machine frames come before the first tick.
        starts_with_first_tick_ = now_ns_ == 0;
        if (starts_with_first_tick_)
            orders.messages.emplace_back("the stage begins with the first tick of the device");
        else
            begin_stage(orders);
        return {};
    }
    run_.command(command, now_ns_);
    return {};
}

void StudyActivity::begin_stage(session::ActivityOrders& orders) {
    run_.command({OperatorSays::start, {}}, now_ns_);
    if (keeper_.begun) tell(keeper_.begun(run_), orders);
    trials_ = {};
    open_world(orders);
    orders.parameters = true;
}

// Checks that the operator may give this order now.
Result<void> StudyActivity::check_order(const OperatorCommand& command) const {
    const bool starts = command.says == OperatorSays::start;
    BURIN_TRY_DO(run_.check(command));
    if (!jig_off_.empty() && (starts || command.says == OperatorSays::go_on))
        return fail("", "the wand read " + jig_off_ + " in its jig",
                    "put it there and say do jig until it reads right");
    return {};
}

Result<void> StudyActivity::check_jig(session::ActivityOrders& orders) {
    if (!device_.wand) return fail("do jig", "the device has no jig", "see to its calibration by its own means");
    const devices::WandDescription& wand = *device_.wand;
    const devices::CalibrationError error = devices::calibration_error(wand, reads_device_);
    const std::string off =
        formatted("%.1f mm and %.2f degrees off (%.1f mm and %.2f degrees are allowed)", 1e3 * error.distance_m,
                  error.angle_rad / devices::kDegree_rad, 1e3 * wand.calibration.tolerance_m,
                  wand.calibration.tolerance_rad / devices::kDegree_rad);
    run_.command({OperatorSays::note, "in the jig the wand reads " + off}, now_ns_);
    jig_off_ = error.within_tolerance ? "" : off;
    jig_row_ = error.distance_m > wand.calibration.tolerance_m
                   ? formatted("%.1f mm off, %.1f allowed", 1e3 * error.distance_m, 1e3 * wand.calibration.tolerance_m)
                   : formatted("%.1f deg off, %.1f allowed", error.angle_rad / devices::kDegree_rad,
                               wand.calibration.tolerance_rad / devices::kDegree_rad);
    if (error.within_tolerance) {
        orders.messages.push_back("jig: the wand reads " + off);
        return {};
    }
    const bool in_stage = run_.phase() == TrainingRun::Phase::in_stage;
    starts_with_first_tick_ = false;
    if (in_stage) run_.command({OperatorSays::pause, {}}, now_ns_);
    const Vec3& jig_m = wand.calibration.maker_from_handle.position_m;
    return fail(
        in_stage ? "STAGE STOPPED" : "do jig", "in its jig the wand reads " + off,
        formatted("put it into the jig, which is at %g, %g, %g m in the maker's frame, and say do jig again; if "
                  "it is there, switch the device off and on in the jig",
                  jig_m.x, jig_m.y, jig_m.z));
}

bool StudyActivity::ends_by_operator() const {
    return run_.place() != nullptr && run_.place()->stage->ends_by_operator;
}

void StudyActivity::step(const session::ActivityView& view, session::ActivityOrders& orders) {
    const session::PartView& wand = view.first_part();
    reads_device_ = {wand.tool.position_device_m,
                     glm::conjugate(wand.tool.workspace.object_from_device.orientation) * wand.tool.orientation_object};
    for (const haptics::TickRecord& tick : wand.ticks) follow(tick, orders);
    if (run_.phase() == TrainingRun::Phase::in_stage && run_.session() != nullptr && run_.session()->touch().leads())
        orders.parameters = true;  // guidance fades and turns
    show(orders);
    // A page that has ended by its time.
    if (run_.phase() == TrainingRun::Phase::ended) end_stage(orders);
}

void StudyActivity::follow(const haptics::TickRecord& tick, session::ActivityOrders& orders) {
    now_ns_ = tick.time_ns;
    if (std::exchange(starts_with_first_tick_, false)) begin_stage(orders);
    if (run_.session() == nullptr || run_.phase() != TrainingRun::Phase::in_stage) return;
    const std::size_t known = run_.session()->events().size();
    const haptics::TickRecord& own = in_stage_world(tick);
    const study::OperatorAct act = run_.follow(own);
    if (keeper_.tick) keeper_.tick({&own, act, run_.session()});
    note_trials(orders);
    place_proxies(known, orders);
    if (run_.phase() != TrainingRun::Phase::ended) return;
    show(orders);
    end_stage(orders);
}

const haptics::TickRecord& StudyActivity::in_stage_world(const haptics::TickRecord& tick) {
    if (visit_.has_numbers_of(*world_)) return tick;
    renumbered_ = tick;
    for (std::uint32_t i = 0; i < tick.contact.point_count; ++i) {
        std::uint32_t& object = renumbered_.contact.points[i].object;
        object = static_cast<std::uint32_t>(visit_.number_in(*world_, object));
    }
    return renumbered_;
}

double StudyActivity::known_m() const {
    Box all;
    for (const study::FeltWorld* world : visit_.worlds()) {
        all.include(world->bounds().lo);
        all.include(world->bounds().hi);
    }
    constexpr double kBeyond_m = 1.0;  // farther than a wand reaches
    return device_.placed ? kBeyond_m + glm::length(all.extent()) : 0.0;
}

void StudyActivity::note_trials(session::ActivityOrders& orders) {
    for (const study::TrialMark& mark : trials_.take(*run_.session()))
        orders.trials.push_back({mark.time_ns, mark.begins ? run_.place()->stage->name : "", mark.state});
}

// Has what can be felt of the stage's world felt, and nothing of the one before felt or seen.
void StudyActivity::open_world(session::ActivityOrders& orders) {
    const study::FeltWorld* next = run_.world();
    if (next == nullptr || next == world_) return;
    for (const study::FeltWorld* world : {world_, next}) {
        for (const scene::ObjectId id : world->objects()) {
            const std::string& name = visit_.object(*world, id).name;
            if (world->part().object(id).felt)
                orders.edits.push_back({name, ObjectProperty::felt, {world == next ? 1.0 : 0.0}});
            if (world == world_) orders.edits.push_back({name, ObjectProperty::seen, {0.0}});
        }
    }
    world_ = next;
    as_shown_.clear();
    tube_pressed_.reset();
}

// Where the start cap was touched, as the events from `known` on tell.
void StudyActivity::place_proxies(std::size_t known, session::ActivityOrders& orders) {
    const auto events = std::span(run_.session()->events()).subspan(known);
    if (std::ranges::find(events, study::StageEventKind::start_touched, &study::StageEvent::kind) == events.end())
        return;
    placement_ = {placement_.number + 1, run_.world()->world().spine_m.front()};
    orders.parameters = true;
}

void StudyActivity::show(session::ActivityOrders& orders) {
    shown_ = run_.frame(now_ns_);
    if (keeper_.events && !shown_.events.empty()) tell(keeper_.events(shown_.events), orders);
    if (run_.world() == nullptr || shown_.objects.empty()) {
        // Pages and the time between stages show nothing of any world: who learns by touch must not see the tube.
        std::vector<ShownObject> hidden = shown_objects(*world_, study::Stage{}, group_, {});
        for (ShownObject& one : hidden) one.seen = false;
        show(hidden, orders);
        press(false, orders);
        return;
    }
    show(shown_.objects, orders);
    press(feels_tube(*run_.place()->stage, group_), orders);
}

// Has the tube press on the hand, or not.
void StudyActivity::press(bool pressed, session::ActivityOrders& orders) {
    if (tube_pressed_ == pressed) return;
    tube_pressed_ = pressed;
    const study::StudyWorld& tube = world_->world();
    const std::string& name = visit_.object(*world_, study::kTubeObject).name;
    orders.edits.push_back({name, ObjectProperty::stiffness, {pressed ? tube.wall_N_per_m : kUnfelt_N_per_m}});
    orders.edits.push_back({name, ObjectProperty::damping, {pressed ? tube.wall_Ns_per_m : 0.0}});
}

void StudyActivity::show(const std::vector<ShownObject>& objects, session::ActivityOrders& orders) {
    for (const ShownObject& one : objects) {
        const auto before = as_shown_.find(one.id);
        if (before != as_shown_.end() && before->second == one) continue;
        const std::string& name = visit_.object(*world_, one.id).name;
        orders.edits.push_back({name, ObjectProperty::seen, {one.seen ? 1.0 : 0.0}});
        orders.edits.push_back(
            {name, ObjectProperty::colour, {one.colour[0] / 255.0, one.colour[1] / 255.0, one.colour[2] / 255.0}});
        orders.edits.push_back({name, ObjectProperty::opacity, {one.opacity}});
        as_shown_[one.id] = one;
    }
}

void StudyActivity::stage(picture::Picture& scene, std::size_t /*screen*/) const {
    // Shows nothing but the study's own, as its pictures do: a shadow would tell where the tube is that nobody may see.
    scene.pedestal.visible = scene.box.visible = false;
    scene.workpiece_object = {};
    if (!shown_.wand_seen || !shown_.moment) {
        scene.tool.visible = false;
        return;
    }
    constexpr std::array kColours{Vec3(0.80, 0.12, 0.10), Vec3(0.10, 0.60, 0.18)};
    static const auto kBall = point_ball();
    for (std::size_t i = 0; i < kColours.size(); ++i) {
        const Similarity placed{shown_.moment->points_m[i], shown_.moment->orientation, 1.0};
        scene.objects.push_back({kBall, scene.world_from_object * placed, kColours[i]});
    }
}

void StudyActivity::end_stage(session::ActivityOrders& orders) {
    const study::Stage& stage = *run_.place()->stage;
    const EndedStage ended = run_.take_end();
    ++ended_;
    if (keeper_.ended) tell(keeper_.ended(ended), orders);
    orders.messages.push_back(outcome_text(stage, ended.end));
    orders.parameters = true;
    orders.quit = run_.stopped() || run_.phase() == TrainingRun::Phase::finished;
    show(orders);
}

void StudyActivity::adjust(session::PartOfHand of, haptics::TickParameters& parameters) const {
    parameters.limits.max_force_N = std::min(parameters.limits.max_force_N, protocol_.force_limit_N);
    if (of != session::PartOfHand{}) return;  // not the participant's
    parameters.placement = placement_;
    if (device_.wand && device_.placed)
        parameters.workspace.object_from_device = study::world_from_wand(*device_.wand, world_->bounds());
    const study::StageSession* session = run_.session();
    if (session == nullptr || run_.phase() != TrainingRun::Phase::in_stage || !session->touch().leads()) return;
    parameters.curve = session->touch().parameters().curve;
    parameters.guidance = session->touch().parameters().guidance;
}

session::ActivityPanel StudyActivity::panel() const {
    using Panel = session::ActivityPanel;
    Panel panel{.title = "Study",
                .aside = device_.participant.empty() ? group_.code : device_.participant + ", " + group_.code,
                .page = shown_.page,
                .governs = governs()};
    if (!jig_off_.empty()) panel.widgets.push_back(Panel::Row{"in the jig", jig_row_});
    for (const PanelRow& row : run_.rows()) panel.widgets.push_back(Panel::Row{row.name, row.value});
    const bool in_stage = run_.phase() == TrainingRun::Phase::in_stage;
    const bool calibrated = jig_off_.empty(), paused = run_.paused();
    const bool trial = in_stage && run_.place()->stage->kind == study::StageKind::trial;
    panel.add<Panel::Button>({{"Start", {"start"}, calibrated && run_.phase() == TrainingRun::Phase::between},
                              {"Next", {"next"}, in_stage && ends_by_operator()},
                              {"Pause", {"pause"}, in_stage && !paused},
                              {"Go on", {"go-on"}, calibrated && paused},
                              {"Repeat", {"repeat"}, trial && !paused},
                              {"In the jig", {"jig"}, device_.wand.has_value()},
                              {"Stop", {"stop"}, in_stage, "End the visit for good?"}});
    panel.widgets.push_back(Panel::Field{"Note", {"note"}, "a note that names nobody"});
    return panel;
}

Result<void> StudyActivity::finish() { return keeper_.closed ? keeper_.closed() : Result<void>{}; }

}  // namespace burin::activities
