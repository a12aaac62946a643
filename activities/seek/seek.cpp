// SPDX-License-Identifier: MIT
#include "activities/seek/seek.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <utility>

#include "base/text.hpp"
#include "scene/object_property.hpp"
#include "session/objects/world_objects.hpp"
#include "session/record/session_check.hpp"

namespace burin::activities {
namespace {

using scene::ObjectProperty;

constexpr scene::PropertyValue kGlow{1.0, 0.62, 0.1};

constexpr std::array kSeekActs{
    session::Act{"start", "", "Begin a search; one under way is broken off, and what it found is kept"},
    session::Act{"skip", "", "Give this object up, and go on to the next"},
};

// Draws an order of the names, the same for the same seed wherever it is drawn.
std::vector<std::string> in_drawn_order(std::vector<std::string> names, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[random() % i]);
    return names;
}

// Returns where the tool rests in a tick.
const Vec3& place_of(const haptics::TickRecord& tick) { return tick.contact.points[0].proxy_object_m; }

}  // namespace

Result<SeekOptions> seek_options_of(const std::string& settings) {
    SeekOptions options;
    unsigned long long seed = 0;
    if (std::sscanf(settings.c_str(), "seek --targets %u --seed %llu", &options.targets, &seed) == 2) {
        options.seed = seed;
        if (Seek(options).settings() == settings) return options;
    }
    return fail(settings, "are no settings of burin seek", "replay it with the program that recorded it");
}

std::string Seek::settings() const {
    return formatted("seek --targets %u --seed %llu", options_.targets, static_cast<unsigned long long>(options_.seed));
}

std::span<const session::Act> Seek::acts() const { return kSeekActs; }

Result<void> Seek::act(std::span<const std::string> words, session::ActivityOrders& orders) {
    if (words[0] == "start") {
        if (phase_ == Phase::seeking) break_off(orders);
        phase_ = Phase::starting;  // step() knows which objects there are
        return {};
    }
    if (phase_ != Phase::seeking) return fail("command do skip", "nothing is sought", "do start first");
    give_up(orders);
    take_next(orders);
    return {};
}

void Seek::give_up(session::ActivityOrders& orders) {
    now_.skipped = true;
    if (since_ns_) orders.trials.push_back({last_ns_, "", "given up"});
    end_glow(orders);
    found_.push_back(std::exchange(now_, {}));
}

void Seek::break_off(session::ActivityOrders& orders) {
    give_up(orders);
    orders.messages.push_back(formatted("search %zu broken off at object %zu of %zu; what it found is kept", searches_,
                                        sought_now(), targets_.size()));
}

std::size_t Seek::sought_now() const {
    return static_cast<std::size_t>(std::ranges::count(found_, searches_, &Sought::search));
}

void Seek::step(const session::ActivityView& view, session::ActivityOrders& orders) {
    if (view.world == nullptr) return;
    if (phase_ == Phase::starting) begin(*view.world, orders);
    auto event = view.contacts.begin();
    for (const haptics::TickRecord& tick : view.first_part().ticks) {
        go_on_by(tick, *view.world, orders);
        for (; event != view.contacts.end() && event->time_ns <= tick.time_ns; ++event)
            feel(*event, *view.world, orders);
        last_ns_ = tick.time_ns;
        last_place_scene_ = place_of(tick);
    }
    // Takes the events that are left: they are later than the first part's ticks, since the scene has read more ticks
    // of other parts.
    for (; event != view.contacts.end(); ++event) feel(*event, *view.world, orders);
    if (phase_ == Phase::seeking && !its_colour_) let_glow(*view.world, orders);
}

void Seek::begin(const session::WorldObjects& world, session::ActivityOrders& orders) {
    std::vector<std::string> names;
    for (const auto& object : world.objects)
        if (object->seen && object->felt) names.push_back(object->name);
    if (names.empty()) orders.messages.emplace_back("nothing can be sought: no object is both seen and felt");
    if (!names.empty() && names.size() < options_.targets)
        orders.messages.push_back(formatted("%zu objects can be sought, not %u: each that is seen and felt, once",
                                            names.size(), options_.targets));
    targets_ = in_drawn_order(std::move(names), options_.seed);
    if (options_.targets > 0 && options_.targets < targets_.size()) targets_.resize(options_.targets);
    ++searches_;
    counts_anew_ = true;
    phase_ = Phase::seeking;
    take_next(orders);
}

// Names the next target; the one before has been put among those found.
void Seek::take_next(session::ActivityOrders& orders) {
    its_colour_.reset();
    since_ns_.reset();
    now_ = {};
    now_.search = searches_;
    const std::size_t sought = sought_now();
    if (sought < targets_.size()) {
        now_.object = targets_[sought];
        return;
    }
    phase_ = Phase::over;
    ended_.push_back(searches_);
    double time_s = 0.0;
    for (const Sought& one : found_) time_s += one.search == searches_ ? one.time_s : 0.0;
    orders.messages.push_back(formatted("%zu objects sought in %.1f s", sought, time_s));
}

void Seek::go_on_by(const haptics::TickRecord& tick, const session::WorldObjects& world,
                    session::ActivityOrders& orders) {
    if (phase_ != Phase::seeking) return;
    if (!since_ns_) {
        since_ns_ = last_ns_ > 0 ? last_ns_ : tick.time_ns;
        orders.trials.push_back({*since_ns_, now_.object});
        if (last_ns_ == 0) last_place_scene_ = place_of(tick);
    }
    now_.time_s = seconds(tick.time_ns - *since_ns_);
    now_.path_m += glm::length(place_of(tick) - last_place_scene_);
    if (!std::exchange(counts_anew_, false)) return;
    for (const scene::ObjectId id : std::vector(touched_)) touch(id, tick.time_ns, world, orders);
}

void Seek::feel(const scene::ContactEvent& event, const session::WorldObjects& world, session::ActivityOrders& orders) {
    const auto known = std::ranges::find(touched_, event.object);
    if (event.what == scene::ContactEvent::What::end) {
        if (known != touched_.end()) touched_.erase(known);
        return;
    }
    const bool is_new = known == touched_.end();  // another finger may touch it already
    touched_.push_back(event.object);
    if (is_new && phase_ == Phase::seeking && since_ns_) touch(event.object, event.time_ns, world, orders);
}

void Seek::touch(scene::ObjectId id, Nanoseconds time_ns, const session::WorldObjects& world,
                 session::ActivityOrders& orders) {
    const scene::SceneObject* object = world.find(id);
    if (object == nullptr || phase_ != Phase::seeking) return;
    if (object->name != now_.object) {
        ++now_.others;
        return;
    }
    end_glow(orders);
    orders.trials.push_back({time_ns, "", "found"});
    orders.messages.push_back(formatted("found %s in %.1f s", now_.object.c_str(), now_.time_s));
    found_.push_back(now_);
    take_next(orders);
}

void Seek::let_glow(const session::WorldObjects& world, session::ActivityOrders& orders) {
    const auto id = object_named(world, now_.object);
    if (!id) return;
    its_colour_ = scene::value_of(*world.find(*id), ObjectProperty::colour);
    orders.edits.push_back({now_.object, ObjectProperty::colour, kGlow});
}

void Seek::end_glow(session::ActivityOrders& orders) {
    if (its_colour_) orders.edits.push_back({now_.object, ObjectProperty::colour, *its_colour_});
    its_colour_.reset();
}

std::uint64_t Seek::check() const {
    session::CheckSum sum;
    sum.add(static_cast<std::uint64_t>(phase_));
    sum.add(std::uint64_t{searches_});
    sum.add(std::uint64_t{found_.size()});
    sum.add(std::uint64_t{now_.others});
    sum.add(now_.time_s);
    sum.add(now_.path_m);
    return sum.sum();
}

session::ActivityPanel Seek::panel() const {
    using Panel = session::ActivityPanel;
    Panel panel{.title = "Seek"};
    switch (phase_) {
        case Phase::waiting: panel.page = "Press Start. Then touch each object that is named and glows."; break;
        case Phase::starting:
        case Phase::seeking: panel.page = "Touch: " + now_.object; break;
        case Phase::over: panel.page = "That was all, and is kept. Press Start to seek them again."; break;
    }
    if (!targets_.empty()) panel.aside = formatted("%zu of %zu", sought_now(), targets_.size());
    if (phase_ == Phase::seeking) panel.widgets.push_back(Panel::Row{"Time", formatted("%.0f s", now_.time_s)});
    if (!found_.empty()) {
        const Sought& last = found_.back();
        panel.widgets.push_back(Panel::Row{last.object, last.skipped ? "given up" : formatted("%.1f s", last.time_s)});
    }
    panel.add<Panel::Button>({{"Start", {"start"}}, {"Skip", {"skip"}, phase_ == Phase::seeking}});
    return panel;
}

Json Seek::report() const {
    Json json{{"activity", settings()}, {"searches", Json::array()}, {"sought", Json::array()}};
    for (std::size_t search = 1; search <= searches_; ++search)
        json["searches"].push_back(
            {{"search", search}, {"complete", std::ranges::find(ended_, search) != ended_.end()}});
    for (const Sought& one : found_)
        json["sought"].push_back({{"search", one.search},
                                  {"object", one.object},
                                  {"found", !one.skipped},
                                  {"time_s", one.time_s},
                                  {"path_m", one.path_m},
                                  {"other_objects_touched", one.others}});
    return json;
}

}  // namespace burin::activities
