// SPDX-License-Identifier: MIT
#include "session/live/scene_side.hpp"

#include <utility>

#include "session/state/session_state.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {

SceneSide::SceneSide(SessionHands& hands) : hands_(hands) {}
SceneSide::~SceneSide() = default;

void SceneSide::take(std::unique_ptr<workpiece::Workpiece> workpiece) { workpiece_ = std::move(workpiece); }

const compute::CarvingEngine* SceneSide::engine() const { return workpiece_ ? &workpiece_->engine() : nullptr; }
const compute::Surface* SceneSide::surface() const { return workpiece_ ? &workpiece_->surface() : nullptr; }
double SceneSide::spacing_m() const { return workpiece_ ? workpiece_->surface().lattice().spacing_m : 0.0; }
Vec3 SceneSide::lattice_origin_object() const {
    return workpiece_ ? workpiece_->surface().lattice().origin_object : Vec3(0.0);
}

Result<void> SceneSide::begin(const workpiece::UseTool& use, std::size_t undo_bytes, std::span<const Beginning> hands,
                              scene::ScenePart* brought, SampleTap* tap, Nanoseconds start_ns) {
    std::vector<scene::ScenePart*>& parts = parts_;
    if (workpiece_) {
        carved_ = &workpiece_->begin(use, undo_bytes, hands_.parts());
        parts.push_back(carved_);
    }
    tools_around_m_.assign(hands_.hands(), toolbox::around_m(use.tool));
    if (world_) {
        for (std::size_t part = 0; part < hands_.parts(); ++part) world_->part().grip_with(part, kGrips);
        parts.push_back(&world_->part());
    }
    brought_ = brought;
    if (brought != nullptr) parts.push_back(brought);
    if (tap != nullptr) parts.push_back(tap);
    for (const Beginning& hand : hands) spreads_m_.push_back(hand.spread_m);
    std::vector<scene::SceneHand> touched;
    for (std::size_t part = 0; part < hands_.parts(); ++part) {
        const PartOfHand of = hands_.part_of_hand(part);
        const Beginning& hand = hands[of.hand];
        touched.push_back(
            {&hands_.channels(part), hand.at_scene, tools_around_m_[of.hand] + hand.spread_m, hand.reach_m, of});
    }
    service_.emplace(parts, std::move(touched));
    news_.report_of(*service_);
    return service_->update(start_ns);
}

SceneSide::Order SceneSide::carving(workpiece::CarveOrder order, std::size_t hand) {
    return [this, order = std::move(order), hand, spread_m = spreads_m_[hand]] {
        const std::size_t first = hands_.first_part(hand), parts = hands_.parts_of(hand);
        const auto* use = std::get_if<workpiece::UseTool>(&order);
        if (carved_ != nullptr && use == nullptr) carved_->order(order);
        if (use == nullptr) return;
        for (std::size_t part = first; carved_ != nullptr && part < first + parts; ++part) carved_->order(*use, part);
        tools_around_m_[hand] = carved_ != nullptr ? carved_->around_m(first) : toolbox::around_m(use->tool);
        for (std::size_t part = first; part < first + parts; ++part)
            service_->use_probe(part, tools_around_m_[hand] + spread_m);
    };
}

SceneSide::Order SceneSide::going(std::uint32_t part, scene::StepWay way) {
    return [this, part, way] {
        if (part < parts_.size()) parts_[part]->go(way);
    };
}

SceneSide::Order SceneSide::saving(document::SaveRequest request, document::DocumentWriter& writer) {
    auto wanted = std::make_shared<document::SaveRequest>(std::move(request));
    workpiece::SaveScene save{[this, wanted, &writer] {
        if (carved_ != nullptr && !wanted->refused) {  // a part that gives its pages counts them as saved
            scene::Pages pages{.whole = !wanted->changed_alone};
            if (const Result<void> saved = carved_->save(pages); !saved) wanted->refused = saved.error();
            wanted->content.parts.insert(wanted->content.parts.begin(), std::move(pages));
            wanted->state += carved_->state();
            // It may have made strokes that the frame did not know of when it asked.
            if (wanted->content.history) wanted->content.history->follow(0, carved_->undo_steps());
        }
        if (brought_ != nullptr && brought_->is_kept() && !wanted->refused) save_brought(*wanted);
        writer.save(std::move(*wanted));
    }};
    return [this, save = std::move(save)] { carved_ != nullptr ? carved_->order(save) : save.save(); };
}

void SceneSide::save_brought(document::SaveRequest& wanted) {
    scene::Pages pages{.whole = !wanted.changed_alone};
    if (const Result<void> saved = brought_->save(pages); !saved) wanted.refused = saved.error();
    wanted.content.parts.push_back(std::move(pages));
    if (wanted.content.history) wanted.content.history->follow(brought_part(), brought_->undo_steps());
}

SceneSide::Order SceneSide::noting(document::Change change, document::DocumentWriter& writer) {
    to_be_noted_.fetch_add(1, std::memory_order_relaxed);
    return Order::aside([this, change = std::move(change), &writer]() mutable {
        writer.note(std::move(change));
        to_be_noted_.fetch_sub(1, std::memory_order_relaxed);
    });
}

SceneSide::Order SceneSide::noting_brought(std::int64_t place, document::History history,
                                           document::DocumentWriter& writer,
                                           std::shared_ptr<std::atomic<bool>> is_due) {
    return Order::aside([this, place, history = std::move(history), &writer, is_due = std::move(is_due)]() mutable {
        scene::Pages pages{.whole = false};
        if (!brought_->note(pages)) return;
        is_due->store(false, std::memory_order_relaxed);
        history.follow(brought_part(), brought_->undo_steps());
        writer.note({.part = place, .pages = std::move(pages), .history = std::move(history)});
    });
}

SceneSide::Order SceneSide::journalling(document::Content content, document::DocumentWriter& writer) {
    return Order::aside([this, content = std::move(content), &writer]() mutable {
        // The workpiece is the first part.
        if (carved_ != nullptr && !carved_->copy(*content.parts.emplace(content.parts.begin()))) return;
        if (brought_ != nullptr && brought_->is_kept() && !brought_->note(content.parts.emplace_back())) return;
        if (carved_ != nullptr && content.history) content.history->follow(0, carved_->undo_steps());
        writer.begin_anew(std::move(content));
    });
}

SceneSide::Order SceneSide::editing(WorldOrder order) {
    return [this, order = std::move(order)] {
        if (const auto done = world_->part().edit(order.object, order.edit); !done) news_.notify(done.error().line());
    };
}

SceneSide::Order SceneSide::holding(HoldOrder order) {
    return [this, order = std::move(order)] {
        scene::MeshPart& part = world_->part();
        const auto done =
            order.parts.empty() ? part.let_go(order.object) : part.take_hold(order.object, order.parts, order.felt);
        if (!done) news_.notify(done.error().line());
    };
}

void SceneSide::light(const SessionState& state, bool turns, Nanoseconds time_ns, const Give& give) {
    const auto lamp = carved_ != nullptr ? lamp_.look(state, turns, time_ns) : std::nullopt;
    if (lamp) give(carving(workpiece::LightFrom{*lamp}, state.hand));
}

void SceneSide::spread(std::size_t hand, double spread_m, const Give& give) {
    if (spread_m == spreads_m_[hand]) return;
    spreads_m_[hand] = spread_m;
    give([this, hand, spread_m] {
        service_->use_probe(hands_.first_part(hand), tools_around_m_[hand] + spread_m);  // a handle is one part
    });
}

}  // namespace burin::session
