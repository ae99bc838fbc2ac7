// Prefixes that become longer, files that are replaced or damaged.
#include "player/prefix_loader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "paim/codec/sequence_bounds.h"
#include "tests/first_components.h"
#include "tests/player/prefix_file.h"
#include "tests/player/test_asset.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

using namespace std::chrono_literals;

constexpr LoaderPace kPace{2ms, 1h};

class PrefixLoaderTest : public testing::Test {
  protected:
    static Asset make_asset(uint32_t num_poses) {
        TestAssetOptions options;
        options.num_poses = num_poses;
        options.num_rings = 4;
        return make_test_asset(options);
    }

    void expect_holds(const LoadedAsset& loaded, const Prefix& prefix) const {
        const CodedMesh& mesh = loaded.asset->moving();
        EXPECT_EQ(mesh.positions.num_components, prefix.geometry_components);
        EXPECT_EQ(mesh.transfer->matrix.num_components, prefix.transfer_components);
        EXPECT_EQ(loaded.asset->complete, prefix == file_.prefixes.back());
        EXPECT_EQ(loaded.progress,
                  (LoadProgress{prefix.size_bytes, file_.bytes.size(),
                                prefix.geometry_components + prefix.transfer_components, 8}));
        const Bounds expected = sequence_bounds(
            first_components(asset_, prefix.geometry_components, prefix.transfer_components));
        EXPECT_EQ(loaded.bounds.lower, expected.lower);
        EXPECT_EQ(loaded.bounds.upper, expected.upper);
        EXPECT_FALSE(loaded.replaced);
    }

    TemporaryDirectory directory_;
    std::filesystem::path path_ = directory_ / "a.paim";
    Asset asset_ = make_asset(6);
    PrefixFile file_{path_, asset_};
};

TEST_F(PrefixLoaderTest, ReadsEveryPrefix) {
    const std::vector<Prefix>& prefixes = file_.prefixes;
    file_.write_up_to(prefixes[0].size_bytes);
    PrefixLoader loader(path_, kPace);
    bool waited = false;
    expect_holds(loader.wait_for_first([&] { waited = true; }), prefixes[0]);
    EXPECT_FALSE(waited);
    ASSERT_EQ(prefixes.size(), 9u);
    for (size_t i = 1; i < prefixes.size(); ++i) {
        // Nothing is read for a component that lacks its last byte.
        file_.write_up_to(prefixes[i].size_bytes - 1);
        loader.wait_for_look();
        EXPECT_EQ(loader.progress().size_bytes, prefixes[i].size_bytes - 1);
        EXPECT_FALSE(loader.take());
        file_.write_up_to(prefixes[i].size_bytes);
        loader.wait_for_look();
        const auto loaded = loader.take();
        ASSERT_TRUE(loaded);
        expect_holds(*loaded, prefixes[i]);
    }
    EXPECT_EQ(loader.take_error(), "");
}

TEST_F(PrefixLoaderTest, WaitsForTheStart) {
    PrefixLoader loader(path_, kPace);
    int num_waits = 0;
    std::jthread writer;
    const LoadedAsset first = loader.wait_for_first([&] {
        ++num_waits;
        writer = std::jthread([&] {
            for (const uint64_t size :
                 {uint64_t{10}, uint64_t{64}, uint64_t{1000}, file_.prefixes[0].size_bytes - 1}) {
                file_.write_up_to(size);
                loader.wait_for_look();
                EXPECT_EQ(loader.progress().size_bytes, size);
            }
            file_.write_up_to(file_.prefixes[2].size_bytes);
        });
    });
    EXPECT_EQ(num_waits, 1);
    expect_holds(first, file_.prefixes[2]);
}

TEST_F(PrefixLoaderTest, GivesUpOnAFileThatStandsStill) {
    const auto expect_failure = [&](const std::string& text) {
        PrefixLoader loader(path_, {2ms, 100ms});
        try {
            loader.wait_for_first([] {});
            ADD_FAILURE() << "expected an error: " << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_EQ(error.what(), path_.string() + text);
        }
    };
    expect_failure(
        ": 0 bytes, expected at least a header and section table, and no more came for 0.1 s");
    file_.write_up_to(100);
    expect_failure(
        ": 100 bytes, expected at least a header and section table, and no more came for 0.1 s");
    const uint64_t playable = file_.prefixes[0].size_bytes;
    file_.write_up_to(playable - 1);
    expect_failure(fmt::format(
        ": {} bytes, expected at least the {} that can be played, and no more came for 0.1 s",
        playable - 1, playable));
}

TEST_F(PrefixLoaderTest, RefusesAtOnceWhatIsNoAnimation) {
    write_file(path_, "neither now nor with more bytes");
    PrefixLoader loader(path_, kPace);
    EXPECT_THROW(loader.wait_for_first([] {}), Error);
}

TEST_F(PrefixLoaderTest, SaysDamageOnceAndGoesOn) {
    const std::vector<Prefix>& prefixes = file_.prefixes;
    file_.write_up_to(prefixes[3].size_bytes);
    PrefixLoader loader(path_, kPace);
    expect_holds(loader.wait_for_first([] {}), prefixes[3]);

    const std::vector<char> good = file_.bytes;
    file_.bytes[prefixes[4].size_bytes - 1] ^= 1;
    file_.write_up_to(prefixes[4].size_bytes);
    loader.wait_for_look();
    const std::string error = loader.take_error();
    EXPECT_NE(error.find("checksum"), std::string::npos) << error;
    file_.write_up_to(good.size());
    loader.wait_for_look();
    EXPECT_EQ(loader.progress().size_bytes, good.size());
    EXPECT_EQ(loader.take_error(), "");
    EXPECT_FALSE(loader.take());

    // Sent again.
    write_file(path_, std::string_view(good.data(), good.size()));
    loader.wait_for_look();
    const auto loaded = loader.take();
    ASSERT_TRUE(loaded);
    expect_holds(*loaded, prefixes.back());
}

// Each part is a prefix, four times as long as the one before or the next longer one, and none is
// read before it is asked for.
TEST_F(PrefixLoaderTest, ReadsALargeFileInParts) {
    file_.write_up_to(file_.bytes.size());
    LoaderPace pace = kPace;
    pace.first_bytes = file_.prefixes[1].size_bytes;
    PrefixLoader loader(path_, pace);
    expect_holds(loader.wait_for_first([] {}), file_.prefixes[1]);
    EXPECT_EQ(loader.progress().size_bytes, file_.prefixes[1].size_bytes);
    uint64_t read_bytes = file_.prefixes[1].size_bytes;
    size_t num_parts = 1;
    for (bool complete = false; !complete; ++num_parts) {
        EXPECT_FALSE(loader.take());
        loader.read_on();
        const LoadedAsset loaded = loader.wait_for_first([] {});
        complete = loaded.asset->complete;
        const auto expected =
            std::find_if(file_.prefixes.rbegin(), file_.prefixes.rend(),
                         [&](const Prefix& prefix) { return prefix.size_bytes <= 4 * read_bytes; });
        expect_holds(loaded, *expected);
        read_bytes = expected->size_bytes;
    }
    EXPECT_GE(num_parts, 2u);
    EXPECT_EQ(loader.take_error(), "");
    loader.check();
}

// Nothing of a damaged part is shown, and the error is that of reading the whole file.
TEST_F(PrefixLoaderTest, EndsWithTheErrorOfAWholeFile) {
    file_.bytes.back() ^= 1;
    file_.write_up_to(file_.bytes.size());
    LoaderPace pace = kPace;
    pace.first_bytes = 1;
    pace.whole = true;
    PrefixLoader loader(path_, pace);
    LoadedAsset loaded = loader.wait_for_first([] {});
    expect_holds(loaded, file_.prefixes[0]);
    loader.check();
    std::string error;
    for (size_t j = 0; j < file_.prefixes.size() && error.empty(); ++j) {
        loader.read_on();
        try {
            loaded = loader.wait_for_first([] {});
            EXPECT_FALSE(loaded.asset->complete);
        } catch (const Error& caught) {
            error = caught.what();
            EXPECT_EQ(caught.code(), ExitCode::bad_input);
        }
    }
    try {
        read_paim(path_);
        ADD_FAILURE() << "the damage was not seen";
    } catch (const Error& whole) {
        EXPECT_EQ(error, whole.what());
    }
    EXPECT_THROW(loader.check(), Error);
}

TEST_F(PrefixLoaderTest, TakesAFileThatReplacesAnother) {
    file_.write_up_to(file_.prefixes[5].size_bytes);
    PrefixLoader loader(path_, kPace);
    expect_holds(loader.wait_for_first([] {}), file_.prefixes[5]);
    std::filesystem::remove(path_);
    loader.wait_for_look();
    EXPECT_EQ(loader.progress().size_bytes, 0u);
    EXPECT_FALSE(loader.take());

    // Shorter and longer than what was there before.
    PrefixFile other(path_, make_asset(9));
    other.write_up_to(other.prefixes[1].size_bytes);
    loader.wait_for_look();
    auto loaded = loader.take();
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(loaded->replaced);
    EXPECT_EQ(loaded->asset->num_poses(), 9u);
    EXPECT_EQ(loaded->progress.components, 1u);
    other.write_up_to(other.bytes.size());
    loader.wait_for_look();
    loaded = loader.take();
    ASSERT_TRUE(loaded);
    EXPECT_FALSE(loaded->replaced);
    EXPECT_TRUE(loaded->asset->complete);
    EXPECT_EQ(loader.take_error(), "");
}

}  // namespace
}  // namespace paim::player
