// SPDX-License-Identifier: MIT
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {

Result<ExportReport> export_csv(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                                const std::string& path, const TickTimes& times) {
    Result<NewFile> file = NewFile::create(path);
    if (!file) return std::unexpected(file.error());
    std::string line;
    const auto add = [&](const std::string& text) { (line += line.empty() ? "" : ",") += text; };
    for (const std::size_t column : columns) add(reader.table(table).columns[column].name);
    if (const auto done = file->write(line + "\n"); !done) return std::unexpected(done.error());
    ExportReport report{0, columns.size(), {}};
    const auto done = each_block(reader, table, times, report, [&](const Block& block) -> Result<void> {
        for (std::uint32_t row = 0; row < block.rows(); ++row) {
            line.clear();
            for (const std::size_t column : columns) add(text_of(block.at(column, row), block.type(column)));
            if (const auto written = file->write(line + "\n"); !written) return written;
        }
        return {};
    });
    if (!done) return std::unexpected(done.error());
    if (const auto ended = file->finish(); !ended) return std::unexpected(ended.error());
    return report;
}

}  // namespace burin::record
