// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/write_picture.h"
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_CASE(a_build_without_pictures_says_what_to_install) {
  using namespace haptic_sculpt::drawing;
  BOOST_CHECK_EXCEPTION(write_picture({}, "picture.png"), Picture_error, [](const Picture_error& error) {
    return std::string(error.what()).find("libepoxy-dev") != std::string::npos;
  });
  BOOST_TEST(!std::filesystem::exists("picture.png"));
}
