// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/statistics.hpp"
#include "base/text.hpp"
#include "bench/document/document_bench.hpp"
#include "bench/measure/timing.hpp"

namespace burin::bench {
namespace {

double megabytes(std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); }

double over(std::uint64_t of, std::uint64_t by) {
    return by > 0 ? static_cast<double>(of) / static_cast<double>(by) : 0.0;
}

// The median of the quotients of runs that were made next to each other.
double open_over_read(const DocumentFigures::Open& open) {
    std::vector<double> quotients;
    for (std::size_t run = 0; run < open.open_ms.size(); ++run)
        quotients.push_back(open.open_ms[run] / open.read_ms[run]);
    return quotients.empty() ? 0.0 : quantile(quotients, 0.5);
}

double at(const std::vector<double>& values, double share) { return values.empty() ? 0.0 : quantile(values, share); }

std::string open_line(const char* name, const DocumentFigures::Open& open) {
    return formatted("  opened %s in %.0f ms, read and unpacked alone in %.0f ms: %.2f times (limit 1.5)\n", name,
                     at(open.open_ms, 0.5), at(open.read_ms, 0.5), open_over_read(open));
}

Json open_json(const DocumentFigures::Open& open) {
    return {{"open_ms", open.open_ms}, {"read_ms", open.read_ms}, {"open_over_read", open_over_read(open)}};
}

}  // namespace

std::string document_table(const DocumentFigures& f) {
    const auto& [updates, changes, unsafe_ms, taken_ms] = f.journal;
    const DocumentFigures::Save& s = f.save;
    std::string text = formatted("%s, journal at N = %d: %llu updates that changed rays, told in %llu changes\n",
                                 f.work.c_str(), f.journal_resolution, static_cast<unsigned long long>(updates),
                                 static_cast<unsigned long long>(changes));
    text += formatted("  on the disk after %.0f ms (median), %.0f ms (p99, limit 1000), %.0f ms (largest)\n",
                      at(unsafe_ms, 0.5), at(unsafe_ms, 0.99), at(unsafe_ms, 1.0));
    text += formatted("  the scene's thread tells a change in %.2f ms (median), %.2f ms (largest)\n", at(taken_ms, 0.5),
                      at(taken_ms, 1.0));
    text += formatted("%u strokes, saved at N = %d: %llu rays changed\n", s.strokes, f.resolution,
                      static_cast<unsigned long long>(s.rays_changed));
    text += formatted(
        "  changed %.2f MB (%.2f MB packed), in pages and steps back %.2f MB packed, written %.2f MB in all\n",
        megabytes(s.changed_bytes), megabytes(s.changed_packed_bytes), megabytes(s.page_bytes),
        megabytes(s.written_bytes));
    text += formatted("  that is %.2f times what changed (limit 2), %.2f times what changed, packed\n",
                      over(s.page_bytes, s.changed_bytes), over(s.page_bytes, s.changed_packed_bytes));
    text += formatted("  the scene's thread stands still for %.1f ms, the document's works for %.0f ms\n", s.taken_ms,
                      s.written_ms);
    text += open_line("cold", f.cold) + open_line("warm", f.warm);
    return text + formatted("  %.2f MB, a binary STL has %.2f MB: %.3f of it (limit 0.25)\n",
                            megabytes(f.size.document_bytes), megabytes(f.size.stl_bytes),
                            over(f.size.document_bytes, f.size.stl_bytes));
}

Json document_json(const DocumentFigures& f) {
    const DocumentFigures::Save& s = f.save;
    return {{"machine", machine()},
            {"work", f.work},
            {"journal",
             {{"resolution", f.journal_resolution},
              {"updates", f.journal.updates},
              {"changes", f.journal.changes},
              {"unsafe_ms",
               {{"median", at(f.journal.unsafe_ms, 0.5)},
                {"p99", at(f.journal.unsafe_ms, 0.99)},
                {"largest", at(f.journal.unsafe_ms, 1.0)}}},
              {"taken_ms", {{"median", at(f.journal.taken_ms, 0.5)}, {"largest", at(f.journal.taken_ms, 1.0)}}}}},
            {"save",
             {{"resolution", f.resolution},
              {"strokes", s.strokes},
              {"rays_changed", s.rays_changed},
              {"changed_bytes", s.changed_bytes},
              {"changed_packed_bytes", s.changed_packed_bytes},
              {"pages", s.pages},
              {"page_bytes", s.page_bytes},
              {"written_bytes", s.written_bytes},
              {"taken_ms", s.taken_ms},
              {"written_ms", s.written_ms}}},
            {"open", {{"cold", open_json(f.cold)}, {"warm", open_json(f.warm)}}},
            {"size", {{"document_bytes", f.size.document_bytes}, {"stl_bytes", f.size.stl_bytes}}}};
}

}  // namespace burin::bench
