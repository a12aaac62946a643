// SPDX-License-Identifier: MIT
// Writes our ticks beside CHAI3D's.
#include <algorithm>
#include <array>
#include <tuple>

#include "base/statistics.hpp"
#include "bench/haptics/haptics_rows.hpp"

namespace burin::bench {
namespace {

constexpr std::array<double, 3> kShares{0.5, 0.99, 0.999};

// The five in turn.
struct Five {
    const PeerTicks *tick = nullptr, *contact = nullptr, *unshaded = nullptr, *fixed = nullptr, *dynamic = nullptr;
};

double ratio(const std::vector<double>& ours, const std::vector<double>& theirs, double share) {
    const double their = quantile(theirs, share);
    return their > 0.0 ? quantile(ours, share) / their : 0.0;
}

// Returns the combinations, those with the largest ratio of cold p99.9, contact to contact in dynamic mode, first.
std::vector<Five> fives_of(const std::vector<PeerTicks>& peers) {
    std::vector<Five> all;
    for (std::size_t i = 0; i + 4 < peers.size(); i += 5)
        all.push_back({&peers[i], &peers[i + 1], &peers[i + 2], &peers[i + 3], &peers[i + 4]});
    const auto worst = [](const Five& f) {
        return std::tuple(-ratio(f.contact->cold_us, f.dynamic->cold_us, 0.999), f.tick->scene, f.tick->triangles,
                          f.tick->probe, f.tick->friction);
    };
    std::ranges::sort(all, {}, worst);
    return all;
}

std::string cells(const std::vector<double>& values, const char* format) {
    std::string text;
    for (const double share : kShares) text += formatted(format, quantile(values, share));
    return text;
}

std::string places(const PeerTicks& t) {
    return formatted(" %8.1f%8.1f%8.2f%6llu", quantile(t.sunk_um, 0.999), quantile(t.from_nearest_um, 0.5),
                     mean(t.from_hand_mm), static_cast<unsigned long long>(t.contact_lost));
}

}  // namespace

Json peer_row(const PeerTicks& t) {
    Json row = {{"scene", t.scene},
                {"triangles", t.triangles},
                {"probe", t.probe},
                {"radius_mm", 1e3 * t.radius_m},
                {"friction", t.friction},
                {"who", t.who},
                {"ticks_cold", t.cold_us.size()},
                {"ticks_back_to_back", t.back_to_back_us.size()}};
    row.update(quantiles("cold", "us", t.cold_us));
    row.update(quantiles("back_to_back", "us", t.back_to_back_us));
    row.update(quantiles("sunk", "um", t.sunk_um));
    row.update(quantiles("from_hand", "mm", t.from_hand_mm));
    row["from_hand_mean_mm"] = mean(t.from_hand_mm);
    if (!t.from_nearest_um.empty()) row.update(quantiles("from_nearest", "um", t.from_nearest_um));
    row["contact_lost"] = t.contact_lost;
    return row;
}

Json peer_ratios(const std::vector<PeerTicks>& peers) {
    Json rows = Json::array();
    for (const Five& f : fives_of(peers)) {
        Json row = {{"scene", f.tick->scene},
                    {"triangles", f.tick->triangles},
                    {"probe", f.tick->probe},
                    {"friction", f.tick->friction}};
        for (const auto& [ours, name] : {std::pair{f.tick, "tick"}, std::pair{f.contact, "contact"}})
            for (const auto& [theirs, mode] : {std::pair{f.fixed, "static"}, std::pair{f.dynamic, "dynamic"}})
                for (const auto& [share, of] :
                     {std::pair{0.5, "p50"}, std::pair{0.99, "p99"}, std::pair{0.999, "p999"}}) {
                    const std::string what = std::string(name) + "_over_" + mode + "_" + of;
                    row["cold_" + what] = ratio(ours->cold_us, theirs->cold_us, share);
                    row["back_to_back_" + what] = ratio(ours->back_to_back_us, theirs->back_to_back_us, share);
                }
        rows.push_back(row);
    }
    return rows;
}

std::string peers_table(const std::vector<PeerTicks>& peers) {
    if (peers.empty()) return "";
    std::string text =
        "ours and CHAI3D's in turn, cold, us: p50, p99, p99.9; ratios of our contact to each of theirs\n";
    text += formatted("%-16s %9s %-10s %-3s%25s%25s%25s%25s%22s%22s\n", "scene", "triangles", "probe", "fri",
                      "our whole tick", "our contact", "theirs, static", "theirs, dynamic", "ratio to static",
                      "ratio to dynamic");
    const std::vector<Five> fives = fives_of(peers);
    for (const Five& f : fives) {
        text += formatted("%-16s %9zu %-10s %-3s ", f.tick->scene.c_str(), f.tick->triangles, f.tick->probe.c_str(),
                          f.tick->friction ? "on" : "off");
        for (const PeerTicks* t : {f.tick, f.contact, f.fixed, f.dynamic}) text += cells(t->cold_us, "%8.1f") + " ";
        for (const PeerTicks* t : {f.fixed, f.dynamic}) {
            text += " ";
            for (const double share : kShares) text += formatted("%7.2f", ratio(f.contact->cold_us, t->cold_us, share));
        }
        text += "\n";
    }
    text +=
        "\nwhere the proxies are: p99.9 of how deep the ball is in the mesh, um; median distance from the mesh's "
        "point\n"
        "nearest to the hand, um, for a point; mean distance from the hand, mm; ticks that lost contact\n";
    text += formatted("%-16s %9s %-10s %-3s%31s%31s%31s%31s\n", "scene", "triangles", "probe", "fri", "ours",
                      "ours, unshaded", "theirs, static", "theirs, dynamic");
    for (const Five& f : fives) {
        text += formatted("%-16s %9zu %-10s %-3s", f.tick->scene.c_str(), f.tick->triangles, f.tick->probe.c_str(),
                          f.tick->friction ? "on" : "off");
        for (const PeerTicks* t : {f.contact, f.unshaded, f.fixed, f.dynamic}) text += places(*t);
        text += "\n";
    }
    return text + "\n";
}

}  // namespace burin::bench
