// XXH3 against its published test value, and streaming against one-shot.
#include "paim/base/hash.h"

#include <gtest/gtest.h>

#include <string>

namespace paim {
namespace {

TEST(Hash, EmptyInputHasThePublishedValue) {
    // XXH3_64bits of nothing with seed 0, from the xxHash sanity tests.
    EXPECT_EQ(xxh3(nullptr, 0), 0x2D06800538D394C2ULL);
}

TEST(Hash, StreamingEqualsOneShot) {
    const std::string text(5000, 'x');
    StreamingHash stream;
    stream.update(text.data(), 1);
    stream.update(text.data() + 1, 3000);
    stream.update(text.data() + 3001, 1999);
    EXPECT_EQ(stream.digest(), xxh3(text.data(), text.size()));
}

}  // namespace
}  // namespace paim
