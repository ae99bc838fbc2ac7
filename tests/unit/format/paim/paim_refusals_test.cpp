// .paim files that are refused: cut, damaged, with claims or numbers that make no sense.
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"
#include "tests/unchecked_file.h"

namespace paim {
namespace {

// Files of integers hold them as floats: larger ones could be written, but not read.
TEST(PaimRefusals, RefusesSingularValuesThatAreNoFloats) {
    const TemporaryDirectory directory;
    Asset asset = make_packed_example(false);
    asset.moving().positions.singular_values[0] = 1e39;
    try {
        write_paim(directory / "x.paim", asset);
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find("a singular value is 1e+39"), std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(directory / "x.paim"));
}

// Whatever a compressed file's bytes are, and even where all checksums are right: an asset that can
// be played, or a clear error.
TEST(PaimRefusals, SurvivesAnyByteOfCompressedSections) {
    const TemporaryDirectory directory;
    for (const bool clustered : {false, true}) {
        write_paim(directory / "x.paim", make_packed_example(clustered));
        const auto whole = read_file(directory / "x.paim", 1 << 20);
        const ContainerReader reader(directory / "x.paim", section::kKindAnimation);
        int refused = 0, read = 0;
        for (size_t s = 0; s < reader.sections().size(); ++s) {
            const Section& damaged = reader.sections()[s];
            for (uint64_t place = 0; place < damaged.stored_size_bytes; ++place) {
                std::vector<SectionPlan> plans;
                for (const Section& section : reader.sections()) {
                    plans.emplace_back(section.spec, section.codec, section.stored_size_bytes);
                }
                ContainerWriter writer(directory / "y.paim", section::kKindAnimation, plans);
                for (size_t j = 0; j < plans.size(); ++j) {
                    const Section& section = reader.sections()[j];
                    std::vector<char> bytes(
                        whole.begin() + static_cast<ptrdiff_t>(section.offset),
                        whole.begin() +
                            static_cast<ptrdiff_t>(section.offset + section.stored_size_bytes));
                    if (j == s) bytes[place] = static_cast<char>(bytes[place] ^ (1 << (place % 8)));
                    writer.append(j, bytes.data(), bytes.size());
                }
                writer.commit();
                try {
                    const Asset asset = read_paim(directory / "y.paim");
                    const auto* const cpca = asset.moving().transfer.as<CpcaTransfer>();
                    ASSERT_EQ(cpca != nullptr, clustered);
                    if (cpca != nullptr) {
                        for (const uint32_t cluster : cpca->clusters.cluster) {
                            ASSERT_LT(cluster, cpca->clusters.num_clusters);
                        }
                    }
                    ++read;
                } catch (const Error& error) {
                    EXPECT_TRUE(error.code() == ExitCode::bad_input ||
                                error.code() == ExitCode::unsupported)
                        << error.what();
                    EXPECT_NE(std::string(error.what()).find("y.paim"), std::string::npos);
                    ++refused;
                }
            }
        }
        EXPECT_GT(refused, 300);  // frames and shapes
        EXPECT_GT(read, 30);      // numbers that are merely others
    }
}

TEST(PaimRefusals, TakesNoMemoryForVerticesThatNothingIsClaimedOf) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    Asset asset = make_packed_example(false);
    write_paim(path, asset);
    // Without the mean of the geometry, and two thousand million vertices.
    const auto bytes = read_file(path, 1 << 20);
    const ContainerReader reader(path, section::kKindAnimation);
    std::string metadata = reader.read_text(reader.require(section::kMetadata, ScalarType::u8));
    const std::string count = "\"num_vertices\": 4";
    metadata.replace(metadata.find(count), count.size(), "\"num_vertices\": 2147483647");
    std::vector<SectionPlan> plans{SectionSpec{
        section::kMetadata, ScalarType::u8, 0, {1, 1, static_cast<uint32_t>(metadata.size())}}};
    std::vector<std::string> contents{metadata};
    for (const Section& section : reader.sections()) {
        if (section.spec.tag == section::kMetadata || section.spec.tag == section::kMean[0])
            continue;
        plans.emplace_back(section.spec, section.codec, section.stored_size_bytes);
        contents.emplace_back(bytes.data() + section.offset, section.stored_size_bytes);
    }
    ContainerWriter writer(path, section::kKindAnimation, plans);
    for (size_t j = 0; j < plans.size(); ++j) {
        writer.append(j, contents[j].data(), contents[j].size());
    }
    writer.commit();
    try {
        read_paim(path);
        ADD_FAILURE() << "read a file without positions";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("GMEA 0 is missing"), std::string::npos)
            << error.what();
    }
}

TEST(PaimRefusals, RefusesClaimsOfFarMoreValuesThanBytes) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    ContainerWriter writer(path, section::kKindAnimation,
                           {SectionPlan({Tag("TMEA"), ScalarType::i8, 0, {1, 1u << 15, 1u << 15}},
                                        SectionCodec::planes, 3)});
    writer.append(0, "abc", 3);
    writer.commit();
    try {
        const ContainerReader reader(path, section::kKindAnimation);
        ADD_FAILURE() << "opened a file of a gigabyte of claims";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("sections claim more than"), std::string::npos)
            << error.what();
    }
}

// What predicts them takes 40 bytes a vertex, whatever they are packed to.
TEST(PaimRefusals, RefusesMoreVerticesThanASmallFileMayHave) {
    const TemporaryDirectory directory;
    Asset asset = quantise_example(make_example_asset(1));
    asset.moving().topology = {2'000'000, {}};
    const auto empty = [&](LowRank& matrix) {
        matrix.num_points = asset.moving().topology.num_vertices;
        matrix.num_components = 0;
        matrix.mean = std::vector<int8_t>(matrix.num_rows());
        matrix.components.clear();
        matrix.weights.clear();
    };
    empty(asset.moving().positions);
    empty(asset.moving().transfer->matrix);
    try {
        write_paim(directory / "x.paim", asset);
        ADD_FAILURE() << "written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_NE(std::string(error.what()).find("2000000 vertices and"), std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(directory / "x.paim"));
}

TEST(PaimRefusals, RefusesCutsAtFiftyPlaces) {
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", make_example_asset(5));
    const auto whole = read_file(directory / "x.paim", 1 << 20);
    for (size_t cut = 0; cut < 50; ++cut) {
        const size_t length = whole.size() * cut / 50;
        write_file(directory / "cut.paim", {whole.data(), length});
        try {
            read_paim(directory / "cut.paim");
            ADD_FAILURE() << "read a file cut at " << length;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find("cut.paim"), std::string::npos);
        }
    }
}

// Transfer of a codec that this version does not know, of the shape of one that it knows.
class TransferFromElsewhere : public SvdTransfer {
  public:
    using SvdTransfer::SvdTransfer;
    std::string_view codec_name() const override { return "elsewhere"; }
    std::unique_ptr<TransferModel> clone() const override {
        return std::make_unique<TransferFromElsewhere>(*this);
    }
};

TEST(PaimRefusals, RefusesCodecsThatItDoesNotKnow) {
    const TemporaryDirectory directory;
    Asset asset = make_example_asset();
    asset.moving().transfer = TransferFromElsewhere(asset.moving().transfer->matrix);
    write_paim(directory / "x.paim", asset);
    try {
        read_paim(directory / "x.paim");
        ADD_FAILURE() << "read as another codec";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_NE(std::string(error.what()).find("transfer of codec 'elsewhere'"),
                  std::string::npos)
            << error.what();
    }
}

// What reading this asset's file says.
// readable  an asset of the same shapes, if writers refuse the numbers of this one
std::string complaint(const Asset& asset, const Asset* readable = nullptr) {
    const TemporaryDirectory directory;
    if (readable != nullptr) {
        write_unchecked(directory / "x.paim", *readable, asset);
    } else {
        write_paim(directory / "x.paim", asset);
    }
    try {
        read_paim(directory / "x.paim");
        return "nothing";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
}

TEST(PaimRefusals, RefusesContentsThatCannotBePlayed) {
    Asset asset = make_example_asset();
    asset.moving().topology.triangles[1][2] = 4;
    EXPECT_NE(complaint(asset).find("triangle 1: vertex 4, expected 0 to 3"), std::string::npos);

    const Asset whole = make_example_asset();
    asset = whole;
    StoredValues& component = asset.moving().transfer->matrix.components[0];
    std::vector<float> values = component.floats();
    values[5] = std::nanf("");
    component = std::move(values);
    EXPECT_NE(complaint(asset, &whole).find("section TCMP: value 5 is nan"), std::string::npos)
        << complaint(asset, &whole);

    asset = make_example_asset();
    asset.moving().positions.singular_values = {1.0, 2.0, 0.5};
    EXPECT_NE(complaint(asset).find("descending"), std::string::npos);

    asset = make_example_asset();
    asset.moving().albedo.values.resize(3, Vec3f::Zero());
    EXPECT_NE(complaint(asset).find("expected 1 or 4 colours"), std::string::npos);

    asset = make_example_asset();
    asset.provenance_json = std::string(100, '[') + std::string(100, ']');
    asset.provenance_json = "{\"a\": " + asset.provenance_json + "}";
    EXPECT_NE(complaint(asset).find("nested more than 16 deep"), std::string::npos);

    asset = make_example_asset(2, 1, 2, 7);  // of two poses, each with two exceptions
    EXPECT_NE(complaint(asset).find("'geometry_components': expected 0 to 6, got 7"),
              std::string::npos);

    const TransferLayout layout = whole.moving().layout;
    const Asset with_floats = with_still(whole, make_example_still(layout));
    asset = with_floats;
    asset.still()->topology.triangles[1][0] = 4;
    EXPECT_NE(complaint(asset).find("triangle 1: vertex 4, expected 0 to 3"), std::string::npos);
    asset = with_floats;
    std::vector<float> positions = asset.still()->positions.mean.floats();
    positions[7] = std::nanf("");
    asset.still()->positions.mean = positions;
    EXPECT_NE(complaint(asset, &with_floats).find("section SPOS: value 7 is nan"),
              std::string::npos);
    asset = with_floats;
    std::vector<float> transfer = asset.still()->transfer->matrix.mean.floats();
    transfer[3] = std::numeric_limits<float>::infinity();
    asset.still()->transfer->matrix.mean = transfer;
    EXPECT_NE(complaint(asset, &with_floats).find("section STRN: value 3 is inf"),
              std::string::npos);
    asset = with_still(whole, make_quantised_still(layout));
    asset.still()->transfer->matrix.steps[1] = -1.0f;
    EXPECT_NE(complaint(asset).find("steps: expected numbers from 0 to 1.04e+34, got -1"),
              std::string::npos)
        << complaint(asset);
    asset = with_floats;
    asset.still()->albedo.values.resize(3);
    EXPECT_NE(complaint(asset).find("expected 1 or 4 colours"), std::string::npos);

    asset = make_example_asset();
    asset.moving().layout.in_bands = 3;  // says 9 planes, holds 4
    EXPECT_NE(complaint(asset).find("expected 9 x 4"), std::string::npos) << complaint(asset);
}

}  // namespace
}  // namespace paim
