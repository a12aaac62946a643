// SPDX-License-Identifier: MIT
#include "bench/stroke/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/try.hpp"
#include "bench/measure/surface_errors.hpp"
#include "bench/measure/timing.hpp"
#include "bench/peers/peers.hpp"
#include "bench/stroke/stroke.hpp"
#include "bench/stroke/stroke_report.hpp"
#include "gpu/device.hpp"

namespace burin::bench {
namespace {

constexpr int kReferenceRays = 2048;          // a side, for the volume of a part of the scene
constexpr double kCellWithoutCells_m = 1e-2;  // stands in for the cell in measures of a mesh that has no cells

class Runs {
public:
    Runs(const ParetoOptions& options, const std::function<void(const std::string&)>& notify)
        : options_(options), tell_(notify), scene_(stroke_1000_scene()) {
        if (options.updates < scene_.sweeps.size()) scene_ = beginning_of(scene_, options.updates, kReferenceRays);
    }

    Result<Pareto> all() {
        pareto_.machine = machine();
        for (int n = options_.smallest; n <= options_.largest; n *= 2) {
            BURIN_TRY_DO(burin({n, false, options_.threads}));
        }
        vulkan();
        if (has_peers()) {
            for (const VdbMethod method : {VdbMethod::csg_difference, VdbMethod::leaf_brush}) {
                for (int n = options_.smallest; n <= options_.largest; n *= 2) openvdb(n, method);
            }
            for (const int subdivisions : {2, 3, 4}) cgal(subdivisions);
        } else {
            pareto_.left_out.emplace_back(
                "OpenVDB and CGAL: not built in (scripts/setup --peers, then configure with -DBURIN_WITH_PEERS=ON)");
        }
        return std::move(pareto_);
    }

private:
    Result<void> burin(const StrokeOptions& options) {
        BURIN_TRY(run, run_stroke(scene_, options));
        Json row = {{"series", series_of(run)}};
        tell_(row["series"].get<std::string>() + ", " + std::to_string(options.resolution) + " cells a side");
        row.update(describe(scene_, run, measure(run.mesh, scene_, run.cell_m),
                            count_self_intersections(run.mesh, options.threads)));
        pareto_.rows.push_back(std::move(row));
        return {};
    }

    [[nodiscard]] static std::string series_of(const StrokeRun& run) {
        if (run.engine == "cpu") return "Burin cpu, " + std::to_string(run.threads) + " threads";
        return "Burin vulkan on " + run.device + (run.software_device ? " (software)" : "");
    }

    void vulkan() {
        int largest = options_.largest;
        const Result<gpu::Device> device = gpu::Device::create();
        if (!device) {
            pareto_.left_out.push_back("Burin vulkan: " + device.error().line());
            return;
        }
        if (device->info().is_software() && largest > options_.largest_on_software_vulkan) {
            largest = options_.largest_on_software_vulkan;
            pareto_.left_out.push_back("Burin vulkan: above " + std::to_string(largest) + " cells a side on " +
                                       device->info().name + ", a software device");
        }
        for (int n = options_.smallest; n <= largest; n *= 2) {
            if (const auto done = burin({n, true, options_.threads}); !done) {
                pareto_.left_out.push_back("Burin vulkan: " + done.error().line());
                return;
            }
        }
    }

    void peer(const CarveScene& scene, const Result<PeerRun>& run, double cell_m) {
        if (!run) {
            pareto_.left_out.push_back(run.error().line());
            return;
        }
        Json row = {{"series", run->peer + " " + run->method + ", " + std::to_string(run->threads) +
                                   (run->threads == 1 ? " thread" : " threads")}};
        tell_(row["series"].get<std::string>() + ", " + run->detail);
        const SurfaceErrors errors = measure(run->mesh, scene, cell_m > 0.0 ? cell_m : kCellWithoutCells_m);
        row.update(describe(scene, *run, errors, cell_m));
        add_comparison(row);
        pareto_.rows.push_back(std::move(row));
    }

    void openvdb(int resolution, VdbMethod method) {
        const Result<compute::Lattice> lattice = compute::lattice_around({Vec3(0.0), Vec3(1.0)}, resolution);
        if (!lattice) return;
        const unsigned threads = WorkerPool(options_.threads).threads();
        peer(scene_, run_openvdb(scene_, *lattice, threads, method), lattice->spacing_m);
    }

    void cgal(int subdivisions) {
        const CarveScene scene =
            beginning_of(scene_, std::min(options_.cgal_updates, scene_.sweeps.size()), kReferenceRays);
        peer(scene, run_cgal(scene, subdivisions), 0.0);
    }

    void add_comparison(Json& row) const {
        std::vector<TimeAndError> ours;
        for (const Json& other : pareto_.rows) {
            if (other.value("engine", "") != "cpu") continue;
            ours.push_back({other["update_ms_median"].get<double>(), other["cut_rms_m"].get<double>()});
        }
        const auto our_ms = time_at_error(ours, row["cut_rms_m"].get<double>());
        row["burin_cpu_faster_at_equal_cut_error"] =
            our_ms ? Json(row["update_ms_median"].get<double>() / *our_ms) : Json(nullptr);
    }

    ParetoOptions options_;
    const std::function<void(const std::string&)>& tell_;
    CarveScene scene_;
    Pareto pareto_;
};

}  // namespace

Result<Pareto> run_pareto(const ParetoOptions& options, const std::function<void(const std::string&)>& notify) {
    return Runs(options, notify).all();
}

std::optional<double> time_at_error(const std::vector<TimeAndError>& points, double error) {
    if (points.empty() || !(error > 0.0)) return std::nullopt;
    if (error >= points.front().error) return points.front().update_ms;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const TimeAndError &coarse = points[i - 1], &fine = points[i];
        if (error > coarse.error || error < fine.error) continue;
        const double share = std::log(error / coarse.error) / std::log(fine.error / coarse.error);
        return coarse.update_ms * std::pow(fine.update_ms / coarse.update_ms, share);
    }
    return std::nullopt;
}

}  // namespace burin::bench
