// .paim files with numbers that writers refuse, for tests of readers.
#pragma once

#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "paim/base/file.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/paim_write.h"
#include "paim/format/paim/section_table.h"

namespace paim {

// The numbers of a row as bytes; empty if they are integers.
struct NumbersOfRow {
    using Bytes = std::vector<char>;
    Bytes operator()(const Weights& row) const { return bytes(row.matrix->weights); }
    Bytes operator()(const Steps& row) const { return bytes(row.matrix->steps); }
    Bytes operator()(const MatrixValues& row) const { return (*this)(row.values); }
    Bytes operator()(StoredValues* values) const {
        return values->holds_floats() ? bytes(values->floats()) : Bytes();
    }
    Bytes operator()(std::vector<float>* values) const { return bytes(*values); }
    Bytes operator()(RootMotion* motion) const { return bytes(root_numbers(*motion)); }
    template <typename Row>
    Bytes operator()(const Row&) const {
        return {};
    }

  private:
    template <typename Number>
    static Bytes bytes(const std::vector<Number>& numbers) {
        const auto* const first = reinterpret_cast<const char*>(numbers.data());
        return {first, first + numbers.size() * sizeof(Number)};
    }
};

// Writes an asset that readers take, with the numbers of another one of the same shapes.
inline void write_unchecked(const std::filesystem::path& path, const Asset& readable,
                            const Asset& other) {
    write_paim(path, readable);
    const std::vector<char> bytes = read_file(path, uint64_t{1} << 20);
    const ContainerReader reader(path, section::kKindAnimation);
    std::vector<SectionPlan> plans;
    std::vector<std::vector<char>> contents;
    for (const Section& section : reader.sections()) {
        const auto first = bytes.begin() + static_cast<ptrdiff_t>(section.offset);
        plans.emplace_back(section.spec, section.codec, section.stored_size_bytes);
        contents.emplace_back(first, first + static_cast<ptrdiff_t>(section.stored_size_bytes));
        for (const TableRow& row : section_table(other)) {
            if (row.tag != section.spec.tag || row.index != section.spec.index) continue;
            std::vector<char> numbers = std::visit(NumbersOfRow(), row.values);
            if (numbers.size() != section.spec.size_bytes()) continue;
            plans.back() = section.spec;
            contents.back() = std::move(numbers);
        }
    }
    ContainerWriter writer(path, section::kKindAnimation, plans);
    for (size_t j = 0; j < plans.size(); ++j) {
        writer.append(j, contents[j].data(), contents[j].size());
    }
    writer.commit();
}

}  // namespace paim
