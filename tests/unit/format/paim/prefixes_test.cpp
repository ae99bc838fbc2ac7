// Prefixes of .paim files: every cut is the whole asset with fewer components, or a clear error.
#include "paim/format/paim/prefixes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/hash.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "tests/example_asset.h"
#include "tests/first_components.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr ReadOptions kPrefix{.prefix = true};

using Bytes = std::vector<char>;

std::vector<std::pair<std::string, Asset>> example_assets() {
    Asset half = make_example_asset(2, 3);
    half.moving().transfer->matrix.precision = Precision::f16;
    half.parts.push_back(make_example_still(half.moving().layout));
    Asset integers = quantise_example(make_example_asset(2, 1, 5, 4));
    for (LowRank* matrix : {&integers.moving().positions, &integers.moving().transfer->matrix}) {
        matrix->weight_steps = {0.25f, 0.0f, 1e-3f, 2.0f};
        for (size_t j = 0; j < matrix->weights.size(); ++j) {
            const auto q = static_cast<float>(j * 977 % 401) - 200.0f;
            matrix->weights[j] = matrix->weight_steps[j / matrix->num_poses] * q;
        }
        // The third of five vanished.
        matrix->singular_values.push_back(0.25 * matrix->singular_values.back());
        matrix->singular_indices = {0, 1, 3, 4};
    }
    integers.parts.push_back(make_quantised_still(integers.moving().layout));
    return {{"f32", make_example_asset(3, 1)},
            {"f16", half},
            {"integers", integers},
            {"clusters", make_clustered_example(2, 3, 2, true)},
            {"clusters of floats", make_clustered_example()},
            {"still", make_example_asset(2, 1, 1, 0)}};
}

void expect_equal(const LowRank& a, const LowRank& b) {
    EXPECT_EQ(a.num_points, b.num_points);
    EXPECT_EQ(a.num_planes, b.num_planes);
    EXPECT_EQ(a.num_poses, b.num_poses);
    EXPECT_EQ(a.num_components, b.num_components);
    EXPECT_EQ(a.precision, b.precision);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.weights, b.weights);
    EXPECT_EQ(a.weight_steps, b.weight_steps);
    EXPECT_EQ(a.singular_values, b.singular_values);
    EXPECT_EQ(a.singular_indices, b.singular_indices);
}

void expect_equal(const CodedMesh& a, const CodedMesh& b) {
    EXPECT_EQ(a.topology, b.topology);
    EXPECT_EQ(a.albedo.values, b.albedo.values);
    EXPECT_EQ(a.layout, b.layout);
    expect_equal(a.positions, b.positions);
    expect_equal(a.transfer->matrix, b.transfer->matrix);
    const auto* const of_a = a.transfer.as<CpcaTransfer>();
    const auto* const of_b = b.transfer.as<CpcaTransfer>();
    ASSERT_EQ(of_a == nullptr, of_b == nullptr);
    if (of_a == nullptr) return;
    EXPECT_EQ(of_a->clusters.num_clusters, of_b->clusters.num_clusters);
    EXPECT_EQ(of_a->clusters.num_components, of_b->clusters.num_components);
    EXPECT_EQ(of_a->clusters.cluster, of_b->clusters.cluster);
    EXPECT_EQ(of_a->clusters.coefficients, of_b->clusters.coefficients);
    EXPECT_EQ(of_a->clusters.scales, of_b->clusters.scales);
}

void expect_equal(const Asset& a, const Asset& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.provenance_json, b.provenance_json);
    EXPECT_EQ(a.vertex_order, b.vertex_order);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (size_t j = 0; j < a.parts.size(); ++j) expect_equal(a.parts[j], b.parts[j]);
}

// What reading says; empty if all is well.
std::string complaint(const std::function<void()>& read) {
    try {
        read();
        return {};
    } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::unsupported);
        return error.what();
    }
}
std::string complaint(const std::filesystem::path& path, const ReadOptions& options) {
    return complaint([&] { read_paim(path, options); });
}

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in: " << text;
}

std::vector<Section> sections_of(const std::filesystem::path& path) {
    return ContainerReader(path, section::kKindAnimation).sections();
}

uint64_t end_of(const Section& section) {
    return section.offset + section.stored_size_bytes;
}

bool is_component(const Section& section) {
    return section.spec.tag == Tag("GCMP") || section.spec.tag == Tag("TCMP");
}

// How many components of a part there are in so many bytes, the slow way.
uint32_t count_components(const std::vector<Section>& sections, Tag tag, uint64_t size_bytes) {
    for (uint32_t k = 0;; ++k) {
        const bool there =
            std::any_of(sections.begin(), sections.end(), [&](const Section& section) {
                return section.spec.tag == tag && section.spec.index == k &&
                       end_of(section) <= size_bytes;
            });
        if (!there) return k;
    }
}

TEST(Prefix, EveryCutIsTheWholeWithFewerComponentsOrAClearError) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    for (const auto& [name, asset] : example_assets()) {
        SCOPED_TRACE(name);
        write_paim(path, asset);
        const Asset whole = read_paim(path);
        EXPECT_TRUE(whole.complete);
        const std::vector<Section> sections = sections_of(path);
        const std::vector<Prefix> prefixes = read_prefixes(path);
        const uint64_t size_bytes = std::filesystem::file_size(path);
        const uint64_t table_end = 64 + 64 * sections.size();
        uint64_t playable = 0;
        for (const Section& section : sections) {
            if (!is_component(section)) playable = std::max(playable, end_of(section));
        }
        EXPECT_EQ(prefixes.front(), (Prefix{playable, 0, 0}));
        const uint32_t num_geometry = whole.moving().positions.num_components;
        const uint32_t num_transfer = whole.moving().transfer->matrix.num_components;
        EXPECT_EQ(prefixes.back(), (Prefix{size_bytes, num_geometry, num_transfer}));
        EXPECT_EQ(prefixes.size(), 1 + num_geometry + num_transfer);
        for (uint64_t cut = size_bytes; cut-- > 0;) {
            SCOPED_TRACE(cut);
            std::filesystem::resize_file(path, cut);
            expect_contains(complaint(path, {}),
                            cut < 64 ? "of a header" : "the file is cut short");
            if (cut < table_end) {
                const std::string needed = std::to_string(cut < 64 ? 64 : table_end);
                expect_contains(complaint([&] { read_prefixes(path); }), "at least the " + needed);
                expect_contains(complaint(path, kPrefix), "at least the " + needed);
                continue;
            }
            ASSERT_EQ(read_prefixes(path), prefixes);
            if (cut < playable) {
                expect_contains(complaint(path, kPrefix),
                                path.string() + ": cut short: " + std::to_string(cut) +
                                    " bytes, expected at least the " + std::to_string(playable) +
                                    " that can be played");
                continue;
            }
            const uint32_t kg = count_components(sections, Tag("GCMP"), cut);
            const uint32_t kt = count_components(sections, Tag("TCMP"), cut);
            const Asset read = read_paim(path, kPrefix);
            EXPECT_FALSE(read.complete);
            expect_equal(read, first_components(whole, kg, kt));
            // The list says the same.
            const auto next =
                std::find_if(prefixes.begin(), prefixes.end(),
                             [&](const Prefix& prefix) { return prefix.size_bytes > cut; });
            EXPECT_EQ(std::prev(next)->geometry_components, kg);
            EXPECT_EQ(std::prev(next)->transfer_components, kt);
            if (testing::Test::HasFailure()) return;  // thousands of the same
        }
    }
}

// Reading the first bytes of a file is reading a file that was cut there, and what comes after them
// may be damaged.
TEST(Prefix, TheFirstBytesOfAFileReadLikeACutFile) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim", cut = directory / "cut.paim";
    for (const auto& [name, asset] : example_assets()) {
        SCOPED_TRACE(name);
        write_paim(path, asset);
        const std::vector<Prefix> prefixes = read_prefixes(path);
        const Bytes good = read_file(path, 1 << 20);
        for (const Prefix& prefix : prefixes) {
            Bytes bytes = good;
            for (size_t j = prefix.size_bytes; j < bytes.size(); ++j) bytes[j] ^= 1;
            write_file(path, std::string_view(bytes.data(), bytes.size()));
            write_file(cut, std::string_view(bytes.data(), prefix.size_bytes));
            const ReadOptions first{.prefix = true, .most_bytes = prefix.size_bytes};
            const Asset read = read_paim(path, first);
            EXPECT_EQ(read.complete, prefix == prefixes.back());
            EXPECT_EQ(read.moving().positions.num_components, prefix.geometry_components);
            EXPECT_EQ(read.moving().transfer->matrix.num_components, prefix.transfer_components);
            expect_equal(read, read_paim(cut, kPrefix));
            if (!read.complete) {
                expect_contains(complaint(path, kPrefix), "damaged");
                expect_contains(complaint(path, {.most_bytes = prefix.size_bytes}), "cut short");
            }
        }
        expect_contains(complaint(path, {.prefix = true, .most_bytes = prefixes[0].size_bytes - 1}),
                        "that can be played");
    }
}

TEST(Prefix, WholeFilesReadAsPrefixesAreComplete) {
    const TemporaryDirectory directory;
    for (const auto& [name, asset] : example_assets()) {
        SCOPED_TRACE(name);
        write_paim(directory / "x.paim", asset);
        const Asset read = read_paim(directory / "x.paim", kPrefix);
        EXPECT_TRUE(read.complete);
        expect_equal(read, read_paim(directory / "x.paim"));
    }
}

TEST(Prefix, RefusesMoreThanTheWholeFile) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    write_paim(path, make_example_asset());
    Bytes bytes = read_file(path, 1 << 20);
    const std::string whole = std::to_string(bytes.size());
    bytes.push_back(0);
    write_file(path, std::string(bytes.begin(), bytes.end()));
    expect_contains(complaint(path, kPrefix), "expected " + whole);
    expect_contains(complaint([&] { read_prefixes(path); }), "expected " + whole);
}

// All that is read is checked, and nothing else is.
TEST(Prefix, RefusesDamageWithinThePrefixOnly) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    for (const auto& [name, asset] : example_assets()) {
        SCOPED_TRACE(name);
        write_paim(path, asset);
        const Bytes bytes = read_file(path, 1 << 20);
        const std::vector<Section> sections = sections_of(path);
        const std::vector<Prefix> prefixes = read_prefixes(path);
        const uint64_t cut = prefixes[prefixes.size() / 2].size_bytes + 1;
        const auto damage = [&](uint64_t place) {
            std::string damaged(bytes.begin(), bytes.end());
            damaged[place] = static_cast<char>(damaged[place] ^ 4);
            damaged.resize(std::min<uint64_t>(cut, damaged.size()));
            std::ofstream(path, std::ios::binary) << damaged;  // often, so not flushed to the disk
            return complaint(path, kPrefix);
        };
        for (const Section& section : sections) {
            if (section.stored_size_bytes == 0) continue;
            for (const uint64_t place : {section.offset, end_of(section) - 1}) {
                const std::string message = damage(place);
                if (end_of(section) <= cut) {
                    expect_contains(message, section.spec.tag.str());
                    expect_contains(message, "damaged: the checksum does not match");
                } else {
                    EXPECT_EQ(message, "");
                }
            }
        }
        for (uint64_t place = 0; place < 64 * (1 + sections.size()); place += 8) {
            EXPECT_NE(damage(place), "") << place;
        }
    }
}

// The example with its header and table changed and their checksums made right again, cut.
void write_hostile(
    const std::filesystem::path& path, uint64_t cut,
    const std::function<void(container::Header&, std::vector<container::TableEntry>&)>& change) {
    write_paim(path, make_clustered_example(2, 1, 1, true));
    const Bytes bytes = read_file(path, 1 << 20);
    std::string whole(bytes.begin(), bytes.end());
    container::Header header;
    std::memcpy(&header, whole.data(), sizeof(header));
    std::vector<container::TableEntry> table(header.num_sections);
    std::memcpy(table.data(), whole.data() + sizeof(header), table.size() * sizeof(table[0]));
    change(header, table);
    const size_t table_bytes = table.size() * sizeof(table[0]);
    header.table_xxh3 = xxh3(table.data(), table_bytes);
    header.header_xxh3 = xxh3(&header, sizeof(header) - sizeof(header.header_xxh3));
    std::memcpy(whole.data(), &header, sizeof(header));
    std::memcpy(whole.data() + sizeof(header), table.data(), table_bytes);
    write_file(path, whole.substr(0, cut));
}

// A header may claim any size, and sections any place in it; memory is taken for what is there.
TEST(Prefix, RefusesHostileTables) {
    using container::Header;
    using Table = std::vector<container::TableEntry>;
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    const auto expect_refused = [&](const auto& change, const char* message) {
        write_hostile(path, ~0ull, change);
        expect_contains(complaint(path, kPrefix), message);
    };
    constexpr uint64_t kHuge = 1ull << 45;
    expect_refused(
        [](Header& h, Table& t) {
            h.file_size_bytes = kHuge;
            auto& triangles = t[1];
            triangles.shape = {1, 1u << 26, 3};
            triangles.raw_size_bytes = 12ull << 26;
        },
        "sections claim more than");
    expect_refused(
        [](Header& h, Table& t) {
            h.file_size_bytes = kHuge;
            t[0].offset = t[1].offset = ~0ull - 2;
        },
        "lie outside");
    expect_refused(
        [](Header& h, Table& t) {
            h.file_size_bytes = kHuge;
            for (auto& entry : t) {  // each within the file, together more than it has
                entry = t.back();
                entry.codec = SectionCodec::zstd;
                entry.offset = 64 + 64 * t.size();
                entry.stored_size_bytes = 512;
            }
        },
        "overlap");
    expect_refused([](Header& h, Table&) { h.file_size_bytes = kHuge, h.num_sections = 1 << 20; },
                   "of header and section table");
    expect_refused([](Header& h, Table&) { h.file_size_bytes = kHuge, h.num_sections = ~0u; },
                   "do not fit");
    expect_refused([](Header& h, Table& t) { h.num_sections = 0, t.clear(); }, "META 0 is missing");
    expect_refused(
        [](Header& h, Table& t) {
            h.file_size_bytes = kHuge;
            t[4].offset = kHuge / 2;
        },
        "that can be played");
    // A component that META counts and the table does not have; what comes after it is of no use.
    expect_refused([](Header&, Table& t) { t[t.size() - 4].index = 7; }, "is missing");
    const Prefix last = read_prefixes(path).back();
    EXPECT_EQ(last.geometry_components + last.transfer_components, 4u);
    // The header alone makes no file large.
    write_hostile(path, ~0ull, [](Header& h, Table&) { h.file_size_bytes = kHuge; });
    EXPECT_TRUE(read_paim(path, kPrefix).complete);
}

// Sections in any order: what counts is when everything that is needed is there.
TEST(Prefix, CountsBytesOfFilesInAnyOrder) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    write_paim(path, make_example_asset(2, 1, 5, 3));
    const Bytes bytes = read_file(path, 1 << 20);
    std::vector<Section> sections = sections_of(path);
    // One component before all else, the others last and backwards.
    std::stable_sort(sections.begin(), sections.end(), [](const Section& a, const Section& b) {
        const auto place = [](const Section& s) {
            if (!is_component(s)) return 1;
            if (s.spec.tag == Tag("GCMP")) return s.spec.index == 0 ? 0 : 2;
            return 5 - static_cast<int>(s.spec.index);
        };
        return place(a) < place(b);
    });
    std::vector<SectionPlan> plans;
    for (const Section& section : sections) {
        plans.emplace_back(section.spec, section.codec, section.stored_size_bytes);
    }
    ContainerWriter writer(directory / "y.paim", section::kKindAnimation, plans);
    for (size_t j = 0; j < plans.size(); ++j) {
        writer.append(j, bytes.data() + sections[j].offset, sections[j].stored_size_bytes);
    }
    writer.commit();
    const std::vector<Section> moved = sections_of(directory / "y.paim");
    const size_t n = moved.size();
    const std::vector<Prefix> expected{{end_of(moved[n - 6]), 1, 0},
                                       {end_of(moved[n - 5]), 2, 0},
                                       {end_of(moved[n - 4]), 3, 0},
                                       {end_of(moved[n - 1]), 3, 3}};
    EXPECT_EQ(read_prefixes(directory / "y.paim"), expected);
    std::filesystem::resize_file(directory / "y.paim", end_of(moved[n - 1]) - 1);
    const Asset read = read_paim(directory / "y.paim", kPrefix);
    EXPECT_FALSE(read.complete);
    expect_equal(read, first_components(read_paim(path), 3, 0));
}

}  // namespace
}  // namespace paim
