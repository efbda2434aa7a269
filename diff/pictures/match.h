/*
 * Which pictures of several sets belong together. Numbers decide where there are some. By their paths are matched:
 * pictures without a number (login.png), those in folders of a set (dark/login.png), and those whose number another
 * picture of their set has too (1_on.png, 1_off.png).
 */
#pragma once

#include "diff/pictures/set.h"

/**
 * Match sets that set_open_named has opened: afterwards entries of one frame number belong together. Pictures that are
 * matched by path keep their name, and have numbers after those of all others, in the order of their names. Where a set
 * is none of files by name (a recording, a pattern), or `only_numbers`, pictures without a number are left out, and a
 * warning says so.
 * @return 0; ERR_INPUT (reported: no picture of a set has a number, or a path that another set has); ERR_USAGE
 *         (reported: two pictures of one name, or of one number and no way to tell them apart); ERR_SYSTEM (reported)
 */
int set_match(struct set *const *sets, size_t n_sets, int only_numbers);
