// The entry point of every test executable; BOOST_TEST_MODULE comes from haptic_sculpt_add_test().
#include <boost/test/unit_test.hpp>
