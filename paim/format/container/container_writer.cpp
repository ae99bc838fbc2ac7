// Writes a section container.
#include "paim/format/container/container_writer.h"

#include <utility>

#include "paim/base/check.h"

namespace paim {

using container::Header;
using container::TableEntry;

namespace {

// Calls place(i, offset) for every section and returns the size of the file.
template <typename Place>
uint64_t lay_out(std::span<const SectionPlan> plans, const Place& place) {
    uint64_t offset = container::align(sizeof(Header) + plans.size() * sizeof(TableEntry));
    uint64_t end = offset;
    for (size_t i = 0; i < plans.size(); ++i) {
        place(i, offset);
        end = offset + plans[i].stored_size_bytes;
        offset = container::align(end);
    }
    return end;
}

}  // namespace

uint64_t container_size_bytes(std::span<const SectionPlan> plans) {
    return lay_out(plans, [](size_t, uint64_t) {});
}

ContainerWriter::ContainerWriter(const std::filesystem::path& path, Tag kind,
                                 const std::vector<SectionPlan>& plans)
    : file_(path), kind_(kind), sections_(plans.size()) {
    PAIM_CHECK_LE(plans.size(), container::kMaxSections);
    file_size_bytes_ = lay_out(plans, [&](size_t i, uint64_t offset) {
        sections_[i].section = {plans[i].spec, offset, plans[i].stored_size_bytes, 0,
                                plans[i].codec};
    });
}

void ContainerWriter::append(size_t section, const void* data, size_t size_bytes) {
    PAIM_CHECK_LT(section, sections_.size());
    Open& open = sections_[section];
    PAIM_CHECK_LE(open.filled_bytes + size_bytes, open.section.stored_size_bytes);
    if (size_bytes == 0) return;
    file_.write_at(open.section.offset + open.filled_bytes, data, size_bytes);
    open.hash.update(data, size_bytes);
    open.filled_bytes += size_bytes;
}

void ContainerWriter::commit() {
    std::vector<TableEntry> table;
    table.reserve(sections_.size());
    for (const Open& open : sections_) {
        const Section& s = open.section;
        PAIM_CHECK_EQ(open.filled_bytes, s.stored_size_bytes);
        table.push_back({s.spec.tag, static_cast<uint8_t>(s.spec.type), s.codec, 0, s.spec.index,
                         s.spec.shape, 0, s.offset, s.stored_size_bytes, s.spec.size_bytes(),
                         open.hash.digest()});
    }
    Header header{container::kMagic,
                  container::kVersion,
                  kind_,
                  file_size_bytes_,
                  static_cast<uint32_t>(table.size()),
                  0,
                  xxh3(table.data(), table.size() * sizeof(TableEntry)),
                  {},
                  0};
    header.header_xxh3 = xxh3(&header, sizeof(header) - sizeof(header.header_xxh3));
    file_.write_at(sizeof(header), table.data(), table.size() * sizeof(TableEntry));
    file_.write_at(0, &header, sizeof(header));
    file_.resize(file_size_bytes_);  // the file has its full size even if the last section is empty
    file_.commit();
}

}  // namespace paim
