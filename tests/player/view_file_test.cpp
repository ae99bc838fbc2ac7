// Views as files: every field there and back, and files that are refused.
#include "player/view/view_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "player/view/view_fields.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

const SceneUnits kSame;  // the model's unit is that of the scene

// A view in which every member that files hold differs from its default. Members are bound to names, all
// that a struct has, so that this does not compile once one is added, until it is set here, too.
ViewState other_view() {
    ViewState view;
    auto& [animation, limits, light, camera, tone_curve, background, surface, coefficient, channel,
           gloss, textures, edges, comparison, split, num_instances, picked] = view;
    auto& [time, playing, speed, ping_pong, in_betweens, turned_back] = animation;
    time = 3.25;
    playing = false;
    speed = -1.75;
    ping_pong = true;
    in_betweens = false;
    limits = {3, 4, 2, 1};
    auto& [orientation, turning, turn_speed_deg, strength, key_on, key] = light;
    orientation = {10.5, -20.25, 30.125};
    turning = false;
    turn_speed_deg = -31.0;
    strength = 0.7;
    key_on = true;
    key = {-33.0, 12.0, {0.1f, 0.2f, 0.3f}, 2.5, 44.0};
    auto& [orbit, target, camera_turn_speed_deg] = camera;
    auto& [place, distance, azimuth_rad, elevation_rad, framed_distance] = orbit;
    place = {0.1, -0.2, 0.3};
    distance = framed_distance = 7.5;
    azimuth_rad = -1.1;
    elevation_rad = 0.9;
    target = CameraTarget::point;
    camera_turn_speed_deg = 5.5;
    tone_curve = {-1.3f, 2.2f, ToneOperator::aces};
    background = {Background::Kind::color, {0.25f, 0.5f, 0.1f}};
    surface = SurfaceView::radiance_error;
    coefficient = 7;
    channel = 1;
    gloss = GlossDetail::vertex;
    textures = false;
    edges = true;
    comparison = Comparison::side_by_side;
    split = 0.3;
    num_instances = 12;
    // Neither is in files: a vertex that somebody has clicked, and which way ping-pong goes.
    static_cast<void>(turned_back);
    static_cast<void>(picked);
    return view;
}

using nlohmann::json;

class ViewFile : public testing::Test {
  protected:
    void write(std::string_view text) { write_file(path_, text); }

    json written(const ViewState& view, const SceneUnits& units = kSame) {
        write_view(path_, view, units);
        const std::vector<char> text = read_file(path_, 1'000'000);
        return json::parse(text.begin(), text.end());
    }

    // Expects that a file of this text is refused, with these words, and that the view stays.
    void expect_refused(std::string_view text, const std::vector<std::string>& words) {
        write(text);
        const ViewState before = other_view();
        ViewState view = before;
        const std::string shown(text.substr(0, 100));
        try {
            read_view(path_, kSame, view);
            ADD_FAILURE() << "accepted: " << shown;
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(error.code(), ExitCode::bad_input) << shown;
            EXPECT_LT(message.size(), 1000u) << shown;
            EXPECT_NE(message.find(path_.string()), std::string::npos) << message;
            for (const std::string& word : words) {
                EXPECT_NE(message.find(word), std::string::npos) << message;
            }
        }
        EXPECT_EQ(view, before) << shown;
    }

    TemporaryDirectory directory_;
    std::filesystem::path path_ = directory_ / "view.json";
};

// {"light": {"yaw_deg": value}} of "light.yaw_deg".
std::string object_with(const std::string& name, const std::string& value) {
    const size_t dot = name.find('.');
    if (dot == std::string::npos) return fmt::format(R"({{"{}": {}}})", name, value);
    return fmt::format(R"({{"{}": {{"{}": {}}}}})", name.substr(0, dot), name.substr(dot + 1),
                       value);
}

// One field of the table, and texts that are no value of it.
struct Field {
    std::string name;
    std::vector<std::string> wrong;
};

// All fields, each with values of other kinds and beyond both ends of its range.
struct WrongValues {
    template <typename Value>
    void number(const char* name, const Value&, double lowest, double highest) {
        fields.push_back({name, kinds({"true", R"("1")", "[1]"})});
        beyond(lowest, highest, "{}");
    }
    void count(const char* name, uint32_t, uint32_t lowest, uint32_t highest) {
        fields.push_back({name, kinds({"true", R"("1")", "[1]", "-1", "0.5", "1e300"})});
        fields.back().wrong.push_back(std::to_string(uint64_t{highest} + 1));
        if (lowest > 0) fields.back().wrong.push_back(std::to_string(lowest - 1));
    }
    void flag(const char* name, bool) {
        fields.push_back({name, kinds({"0", "1", R"("true")", "[true]"})});
    }
    template <typename Vector>
    void vector(const char* name, const Vector&, double lowest, double highest) {
        fields.push_back({name, kinds({"1", "true", "[]", "[1, 1]", "[1, 1, 1, 1]", "[1, 1, null]",
                                       R"([1, 1, "1"])", "[[1, 1, 1]]"})});
        beyond(lowest, highest, "[0.5, {}, 0.5]");
    }
    template <typename Value>
    void word(const char* name, Value, const Names<Value>&) {
        fields.push_back({name, kinds({"0", "true", R"("")", R"("nonsense")"})});
    }

    std::vector<Field> fields;

  private:
    static std::vector<std::string> kinds(std::vector<std::string> others) {
        others.insert(others.end(), {"null", "{}", R"({"a": 1})"});
        return others;
    }
    void beyond(double lowest, double highest, const char* form) {
        for (const double value : {std::nextafter(lowest, -INFINITY),
                                   std::nextafter(highest, INFINITY), -1e300, 1e300}) {
            fields.back().wrong.push_back(fmt::format(fmt::runtime(form), value));
        }
    }
};

std::vector<Field> all_fields() {
    ViewState view;
    WrongValues visitor;
    visit_fields(view, visitor);
    return visitor.fields;
}

TEST_F(ViewFile, HoldsEveryField) {
    const ViewState view = other_view();
    const json by_default = written(ViewState()), file = written(view);
    // Every field of the table differs here, so that none can be left out unnoticed.
    for (const Field& field : all_fields()) {
        std::string path = "/" + field.name;
        std::replace(path.begin(), path.end(), '.', '/');
        const json::json_pointer pointer(path);
        ASSERT_TRUE(file.contains(pointer)) << field.name;
        EXPECT_NE(file.at(pointer), by_default.at(pointer)) << field.name;
    }
    ViewState read;
    read_view(path_, kSame, read);
    EXPECT_EQ(read, view);
}

TEST_F(ViewFile, IsAsPeopleWouldWriteIt) {
    const json file = written(other_view());
    EXPECT_EQ(file["light"]["yaw_deg"], 10.5);
    EXPECT_EQ(file["camera"]["place"], json({0.1, -0.2, 0.3}));
    EXPECT_EQ(file["camera"]["target"], "point");
    EXPECT_EQ(file["surface"]["view"], "radiance-error");
    EXPECT_EQ(file["comparison"]["kind"], "side-by-side");
    EXPECT_EQ(file["instances"], 12);
}

TEST_F(ViewFile, SetsWhatItHasAndLeavesTheRest) {
    write("{}");
    ViewState view = other_view();
    read_view(path_, kSame, view);
    EXPECT_EQ(view, other_view());
    write(R"({"light": {"pitch_deg": 5}, "instances": 3})");
    read_view(path_, kSame, view);
    ViewState expected = other_view();
    expected.light.orientation.pitch_deg = 5.0;
    expected.num_instances = 3;
    EXPECT_EQ(view, expected);
}

TEST_F(ViewFile, NamesTheFieldOfAWrongValue) {
    const std::vector<Field> fields = all_fields();
    ASSERT_GT(fields.size(), 30u);
    for (const Field& field : fields) {
        for (const std::string& value : field.wrong) {
            // An object in a field's place has fields that are unknown.
            expect_refused(object_with(field.name, value), {field.name});
        }
    }
}

TEST_F(ViewFile, RefusesFieldsThatItDoesNotKnow) {
    expect_refused(R"({"lamp": 1})", {"unknown field 'lamp'"});
    expect_refused(R"({"lamp": {}})", {"unknown field 'lamp'"});
    expect_refused(R"({"light": {"yaw": 1}})", {"unknown field 'light.yaw'"});
    expect_refused(R"({"light": {"yaw_deg": 1, "yaw_rad": 1}})", {"'light.yaw_rad'"});
    expect_refused(R"({"light": 1})", {"'light'"});
    expect_refused(R"({"light": [1, 2]})", {"'light'"});
    expect_refused(R"({"light": {"yaw_deg": {"a": 1}}})", {"light.yaw_deg"});
    expect_refused(R"({"light": {"": 1}})", {"'light.'"});
    // Not a way to write "light": {"yaw_deg": 1}.
    expect_refused(R"({"light.yaw_deg": 1})", {"'light.yaw_deg'"});
    expect_refused(R"({"light": {"yaw_deg": 1}, "light.yaw_deg": 1})", {"'light.yaw_deg'"});
    expect_refused(R"({"": {"instances": 1}})", {"''"});
    expect_refused(R"({"a/b": 1})", {"'a/b'"});
}

TEST_F(ViewFile, RefusesWhatIsNoJsonObject) {
    const std::string words = "JSON object";
    for (const char* const text :
         {"", " ", "view", "[]", "1", "null", "{", "{}}", R"({"light": })", R"({"light": {},})",
          R"({"light": {"yaw_deg": NaN}})", R"({"light": {"yaw_deg": Infinity}})",
          R"({"light": {"yaw_deg": 1e999}})", R"({"light": {"yaw_deg": 01}})", "{\"a\xff\": 1}",
          R"({"instances": 1} {"instances": 2})"}) {
        expect_refused(text, {words});
    }
    for (const std::string open : {"[", R"({"a":)"}) {
        std::string deep;
        while (deep.size() + open.size() < 900'000) deep += open;
        expect_refused(deep, {words});
        expect_refused(R"({"light": )" + deep, {words});
    }
    std::string closed(5000, '[');
    closed.append(5000, ']');
    expect_refused(R"({"light": )" + closed + "}", {words});
}

TEST_F(ViewFile, RefusesFilesThatAreTooLargeOrNotThere) {
    std::string text = R"({"instances": 3})";
    text.resize(1'000'000, ' ');
    write(text);
    ViewState view;
    read_view(path_, kSame, view);
    EXPECT_EQ(view.num_instances, 3u);
    expect_refused(text + " ", {});
    std::filesystem::remove(path_);
    view = other_view();
    EXPECT_THROW(read_view(path_, kSame, view), Error);
    EXPECT_EQ(view, other_view());
    EXPECT_THROW(write_view(directory_ / "none" / "view.json", view, kSame), Error);
}

// What a message cites of a long value is short.
TEST_F(ViewFile, ShortensWhatItCites) {
    std::string word(10000, 'a');
    for (size_t i = 0; i + 1 < word.size(); i += 2) word.replace(i, 2, "é");
    for (const char* const name :
         {"camera.target", "surface.view", "light.strength", "instances"}) {
        for (const std::string shift : {"", "a"}) {
            write(object_with(name, '"' + shift + word + '"'));
            ViewState view;
            try {
                read_view(path_, kSame, view);
                FAIL() << name;
            } catch (const Error& error) {
                // Valid UTF-8: what JSON can hold without a replacement.
                EXPECT_NO_THROW(json(error.what()).dump()) << error.what();
                EXPECT_LT(std::string_view(error.what()).size(), 600u);
            }
        }
    }
}

// Files hold scene units, so that they suit the same model however it is scaled in memory.
class ViewUnits : public ViewFile, public testing::WithParamInterface<double> {};

TEST_P(ViewUnits, AreThoseOfTheScene) {
    const double size = GetParam();  // of the model in the scene
    const SceneUnits units{std::exp2(-std::round(std::log2(size))), Vec3d(3.0, -2.0, 5.0) * size};
    ViewState view = other_view();
    for (const CameraTarget target : {CameraTarget::all, CameraTarget::point, CameraTarget::pose}) {
        view.camera.target = target;
        const json file = written(view, units);
        EXPECT_DOUBLE_EQ(file["camera"]["distance"], 7.5 / units.scale);
        const Vec3d origin = target == CameraTarget::pose ? Vec3d(Vec3d::Zero()) : units.origin;
        for (int axis = 0; axis < 3; ++axis) {
            const double expected = view.camera.orbit.target[axis] / units.scale + origin[axis];
            EXPECT_DOUBLE_EQ(file["camera"]["place"][static_cast<size_t>(axis)], expected);
        }
        ViewState read;
        read_view(path_, units, read);
        EXPECT_EQ(read.camera.orbit.distance, 7.5);
        EXPECT_EQ(read.camera.orbit.framed_distance, 7.5);
        // Places are added to the origin and subtracted again, in double.
        const double rounding = 4.0 * 0x1p-52 * (units.origin.norm() * units.scale + 1.0);
        EXPECT_LE((read.camera.orbit.target - view.camera.orbit.target).norm(), rounding);
        read.camera.orbit = view.camera.orbit;
        EXPECT_EQ(read, view);
    }
}

// A model of another size in the same place of the scene sees the same.
TEST_P(ViewUnits, SuitAnotherScale) {
    const double size = GetParam();
    const SceneUnits units{1.0 / size, Vec3d(size, 0.0, -size)};
    const SceneUnits other{4.0 / size, Vec3d(-size, 0.0, 3.0 * size)};
    const ViewState view = other_view();
    write_view(path_, view, units);
    ViewState read;
    read_view(path_, other, read);
    EXPECT_NEAR(read.camera.orbit.distance, 4.0 * 7.5, 1e-12);
    const Vec3d expected = units.to_scene(view.camera.orbit.target);
    const Vec3d place = other.to_scene(read.camera.orbit.target);
    EXPECT_LE((place - expected).norm(), 1e-14 * size * 10.0);
}

// A file without a place does not move the camera, whatever it makes the camera look at.
TEST_P(ViewUnits, LeaveAPlaceThatTheFileDoesNotHave) {
    const double size = GetParam();
    const SceneUnits units{1.0 / size, Vec3d(1e3 * size, 2e3 * size, 3e3 * size)};
    for (const CameraTarget before : {CameraTarget::all, CameraTarget::pose}) {
        for (const char* const target : {"all", "pose", "point"}) {
            write(object_with("camera.target", fmt::format("\"{}\"", target)));
            ViewState view = other_view();
            view.camera.target = before;
            const OrbitCamera orbit = view.camera.orbit;
            read_view(path_, units, view);
            EXPECT_EQ(view.camera.orbit, orbit) << target;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ViewUnits, testing::Values(1e-6, 1.0, 1e6));

// As the option.
TEST_F(ViewFile, RefusesGammaBetweenTheSrgbCurveAndTheLowestPower) {
    for (const char* gamma : {"0.05", "1e-30"}) {
        write(std::string(R"({"display": {"gamma": )") + gamma + "}}");
        ViewState view;
        EXPECT_THROW(read_view(path_, kSame, view), Error) << gamma;
        EXPECT_EQ(view, ViewState());
    }
}

}  // namespace
}  // namespace paim::player
