#include "cli/frames.hpp"

#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/error.hpp"

using raytracer::Error;
using raytracer::ErrorKind;
using raytracer::cli::frames_of;
using raytracer::cli::has_frame_number;
using raytracer::cli::parse_frame_list;
using raytracer::cli::with_frame_number;

namespace {

using Frames = std::vector<int>;

Frames frames(const std::string& text, int count) { return frames_of(parse_frame_list(text), count); }

template <class Call>
std::string usage_error(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::kUsage);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("lists of frames") {
  CHECK(frames("all", 4) == Frames{1, 2, 3, 4});
  CHECK(frames("3", 4) == Frames{3});
  CHECK(frames("2-4", 9) == Frames{2, 3, 4});
  CHECK(frames("3-3", 9) == Frames{3});
  CHECK(frames("1-9x4", 9) == Frames{1, 5, 9});
  CHECK(frames("2-9x4", 9) == Frames{2, 6});
  CHECK(frames("3,7,10-12", 20) == Frames{3, 7, 10, 11, 12});
  CHECK(frames("007", 9) == Frames{7});
}

TEST_CASE("frames come in their order and once, however they are named") {
  CHECK(frames("5,3,3-4,1-9x4", 9) == Frames{1, 3, 4, 5, 9});
}

TEST_CASE("frames clamp to the scene's") {
  CHECK(frames("0-2", 9) == Frames{1, 2});
  CHECK(frames("0-9x4", 9) == Frames{4, 8});
  CHECK(frames("8-1000", 9) == Frames{8, 9});
  CHECK(frames("1-99999999999999999999", 2) == Frames{1, 2});
  CHECK(frames("4,500", 9) == Frames{4});
}

TEST_CASE("a list that names none of the scene's frames is refused with their number") {
  for (const char* text : {"0", "10", "10-20", "99999999999999999999"}) {
    INFO(text);
    const std::string message = usage_error([&] { frames(text, 9); });
    CHECK(message.find("9 frames") != std::string::npos);
  }
}

TEST_CASE("more frames than can be listed are refused") {
  CHECK(usage_error([] { frames("all", 1'000'000'000); }).find("1000000000") != std::string::npos);
}

TEST_CASE("what is no list of frames is refused") {
  for (const char* text :
       {"",   "x",   "-1",  "1-", "-",  "1--2", "1-2x", "1-2x0", "3x2",   "1-2x-1",  "1,",    ",1",    "1,,2",
        "+1", "1.5", "1e3", " 1", "1 ", "1, 2", "9-2",  "ALL",   "all,1", "1-4x2x2", "1-2-3", "\u0663"}) {
    INFO("'" << text << "'");
    CHECK(usage_error([&] { parse_frame_list(text); }).find("--frames") != std::string::npos);
  }
}

TEST_CASE("the frame's number in a name") {
  CHECK(with_frame_number("shot.####.png", 7) == "shot.0007.png");
  CHECK(with_frame_number("#.png", 7) == "7.png");
  CHECK(with_frame_number("##.png", 123) == "123.png");
  CHECK(with_frame_number("a#b/c##", 7) == "a#b/c07");
  CHECK(with_frame_number("shot.png", 7) == "shot.png");
  CHECK(has_frame_number("shot#.png"));
  CHECK_FALSE(has_frame_number("shot.png"));
  CHECK_FALSE(has_frame_number("a#b/shot.png"));
  CHECK(usage_error([] { has_frame_number("a#b#.png"); }).find("a#b#.png") != std::string::npos);
}
