// Prefixes of a file, byte by byte.
#include "player/file_prefix.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/codec/sequence_bounds.h"
#include "tests/player/prefix_file.h"
#include "tests/player/test_asset.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

TEST(LoadProgress, IsSaidInWords) {
    EXPECT_EQ(progress_text({744000, 1200000, 9, 23}), "62 % of 1.2 MB, 9 of 23 components");
    EXPECT_EQ(progress_text({99999, 100000, 3, 4}), "99 % of 100 kB, 3 of 4 components");
    EXPECT_EQ(progress_text({100000, 100000, 4, 4}), "100 % of 100 kB, 4 of 4 components");
    EXPECT_EQ(progress_text({12000, 0, 0, 0}), "12 kB");
}

TEST(FilePrefix, IsInspectedAtEveryLength) {
    const TemporaryDirectory directory;
    const auto path = directory / "a.paim";
    TestAssetOptions options;
    options.num_rings = 3;
    const Asset asset = make_test_asset(options);
    PrefixFile file(path, asset);
    const uint64_t num_bytes = file.bytes.size();
    EXPECT_EQ(inspect_prefix(path).size_bytes, 0u);
    size_t held = 0;  // prefixes
    bool has_table = false;
    for (uint64_t size = 1; size <= num_bytes; ++size) {
        file.write_up_to(size);
        const FilePrefix prefix = inspect_prefix(path);
        ASSERT_EQ(prefix.size_bytes, size);
        ASSERT_TRUE(!has_table || !prefix.prefixes.empty()) << size;
        has_table = !prefix.prefixes.empty();
        if (held < file.prefixes.size() && file.prefixes[held].size_bytes == size) ++held;
        ASSERT_EQ(prefix.playable_bytes(), held == 0 ? 0 : file.prefixes[held - 1].size_bytes);
        if (has_table) {
            ASSERT_EQ(prefix.progress(), (LoadProgress{size, num_bytes, 0, 8}));
        }
    }
    EXPECT_EQ(held, file.prefixes.size());
    EXPECT_TRUE(has_table);

    const LoadedAsset loaded = load_prefix(path);
    EXPECT_TRUE(loaded.asset->complete);
    EXPECT_EQ(loaded.progress, (LoadProgress{num_bytes, num_bytes, 8, 8}));
    EXPECT_EQ(loaded.bounds.lower, sequence_bounds(asset).lower);
    EXPECT_EQ(loaded.bounds.upper, sequence_bounds(asset).upper);
}

TEST(FilePrefix, IsReadInPartsOfSomeBytes) {
    FilePrefix prefix;
    EXPECT_EQ(prefix.playable_bytes(0, 100), 0u);
    prefix.prefixes = {{10, 0, 0}, {20, 1, 0}, {50, 1, 1}, {90, 2, 1}};
    prefix.size_bytes = 60;  // 90 are not there
    EXPECT_EQ(prefix.playable_bytes(), 50u);
    EXPECT_EQ(prefix.playable_bytes(0, 1), 10u);  // the shortest has more
    EXPECT_EQ(prefix.playable_bytes(0, 20), 20u);
    EXPECT_EQ(prefix.playable_bytes(0, 49), 20u);
    EXPECT_EQ(prefix.playable_bytes(20, 49), 50u);  // the next has more
    EXPECT_EQ(prefix.playable_bytes(10, 1000), 50u);
    EXPECT_EQ(prefix.playable_bytes(50, 1000), 50u);
    prefix.size_bytes = 9;
    EXPECT_EQ(prefix.playable_bytes(0, 100), 0u);
}

TEST(FilePrefix, TellsDamageFromWhatIsMissing) {
    const TemporaryDirectory directory;
    const auto path = directory / "a.paim";
    const auto expect_error = [&](const std::string& text) {
        try {
            inspect_prefix(path);
            ADD_FAILURE() << "expected an error: " << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
        }
    };
    write_file(path, "hello");
    expect_error("expected at least the 64 of a header");
    write_file(path, std::string(100, 'x'));
    expect_error("not a Paim file");
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    expect_error("expected a regular file");

    PrefixFile header(directory / "b.paim", make_test_asset({}));
    header.bytes[12] ^= 1;  // of its kind
    header.write_up_to(64);
    EXPECT_THROW(inspect_prefix(directory / "b.paim"), Error);
    PrefixFile table(directory / "c.paim", make_test_asset({}));
    table.bytes[64] ^= 1;
    table.write_up_to(127);
    EXPECT_TRUE(inspect_prefix(directory / "c.paim").prefixes.empty());
    table.write_up_to(table.prefixes[0].size_bytes);
    EXPECT_THROW(inspect_prefix(directory / "c.paim"), Error);
}

}  // namespace
}  // namespace paim::player
