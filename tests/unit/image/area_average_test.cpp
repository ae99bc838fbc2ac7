// Averages: blocks by hand, and sums that must not change.
#include "paim/image/area_average.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"

namespace paim {
namespace {

Image random_image(int width, int height, uint64_t seed) {
    RandomStream random(stream_key(seed, 0, 0));
    Image image(width, height);
    for (Vec3f& pixel : image.pixels) {
        for (float& value : pixel) value = static_cast<float>(random.uniform());
    }
    return image;
}

Image average(const Image& image, int width, int height, RowArea rows) {
    AreaAverage result(image.width, image.height, width, height, rows);
    for (int y = 0; y < image.height; ++y) {
        result.add(0, y, {&image.at(0, y), static_cast<size_t>(image.width)});
    }
    return result.take();
}

// Σ over pixels of radiance · area, over the unit square or the sphere.
Vec3d energy(const Image& image, RowArea rows) {
    Vec3d sum = Vec3d::Zero();
    for (int y = 0; y < image.height; ++y) {
        const double top = static_cast<double>(y) / image.height;
        const double bottom = (y + 1.0) / image.height;
        const double area =
            rows == RowArea::equal ? bottom - top : std::cos(kPi * top) - std::cos(kPi * bottom);
        for (int x = 0; x < image.width; ++x) {
            sum += area / image.width * image.at(x, y).cast<double>();
        }
    }
    return sum;
}

TEST(AreaAverage, EqualSizesCopy) {
    const Image image = random_image(7, 5, 1);
    for (const RowArea rows : {RowArea::equal, RowArea::latlong}) {
        EXPECT_EQ(average(image, 7, 5, rows).pixels, image.pixels);
    }
}

TEST(AreaAverage, WholeAndCutPixels) {
    Image image(3, 2);
    for (int x = 0; x < 3; ++x) {
        image.at(x, 0) = Vec3f::Constant(static_cast<float>(x));
        image.at(x, 1) = Vec3f::Constant(static_cast<float>(x + 10));
    }
    const Image two = average(image, 2, 1, RowArea::equal);
    // 0 and half of 1 over 1.5 columns, in both rows.
    EXPECT_NEAR(two.at(0, 0).x(), 5.0 + 0.5 / 1.5, 1e-6);
    EXPECT_NEAR(two.at(1, 0).x(), 5.0 + 2.5 / 1.5, 1e-6);
}

TEST(AreaAverage, KeepsTheEnergy) {
    const Image image = random_image(37, 23, 2);
    for (const RowArea rows : {RowArea::equal, RowArea::latlong}) {
        const Vec3d before = energy(image, rows);
        for (const auto& [width, height] :
             {std::pair{36, 22}, {19, 23}, {37, 11}, {5, 4}, {1, 1}, {36, 1}}) {
            const Vec3d after = energy(average(image, width, height, rows), rows);
            // 2^-24 for each of 851 sums, which mostly cancel.
            EXPECT_LT((after - before).norm(), 3e-6 * before.norm()) << width << " " << height;
        }
    }
}

TEST(AreaAverage, RunsMayComeInAnyOrder) {
    const Image image = random_image(12, 9, 3);
    AreaAverage pieces(12, 9, 5, 4, RowArea::latlong);
    for (int y = 8; y >= 0; --y) {
        pieces.add(0, y, {&image.at(0, y), 7});
        pieces.add(7, y, {&image.at(7, y), 5});
    }
    const Image whole = average(image, 5, 4, RowArea::latlong);
    const Image result = pieces.take();
    for (size_t i = 0; i < whole.pixels.size(); ++i) {
        EXPECT_LT((result.pixels[i] - whole.pixels[i]).norm(), 1e-6f);
    }
}

TEST(FitLatlong, AveragesWhatIsTooLarge) {
    const Image image = random_image(10, 6, 4);
    EXPECT_EQ(fit_latlong(image, 10, 6).pixels, image.pixels);
    const Image narrow = fit_latlong(image, 5, 99);
    EXPECT_EQ(narrow.width, 5);
    EXPECT_EQ(narrow.height, 6);
    EXPECT_NEAR(narrow.at(2, 3).y(), 0.5 * (image.at(4, 3).y() + image.at(5, 3).y()), 1e-6);
    EXPECT_EQ(fit_latlong(image, 1, 1).pixels.size(), 1u);
}

TEST(AreaAverageDeathTest, DoesNotEnlarge) {
    EXPECT_DEATH(AreaAverage(4, 4, 5, 4, RowArea::equal), "check failed");
    EXPECT_DEATH(AreaAverage(4, 4, 4, 0, RowArea::equal), "check failed");
}

}  // namespace
}  // namespace paim
