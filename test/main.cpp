// The entry point of every test executable; its name comes from haptic_sculpt_add_test().
#define BOOST_TEST_MODULE HAPTIC_SCULPT_TEST_MODULE
#include <boost/test/unit_test.hpp>
