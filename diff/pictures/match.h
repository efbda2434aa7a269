/*
 * Matches the pictures of several sets. Pictures with numbers are matched by number. Three kinds are matched by path:
 * pictures without a number (login.png), pictures in subfolders of a set (dark/login.png), and pictures that share
 * their number with another of their set (1_on.png, 1_off.png).
 */
#pragma once

#include "diff/pictures/set.h"

/**
 * Match sets that set_open_named has opened: afterwards entries with the same frame number belong together. Pictures
 * matched by path keep their names, and get numbers after all others, in the order of their names. If any set has no
 * file names (a recording, a pattern), or with `only_numbers`, pictures without a number are dropped with a warning.
 * @return 0; ERR_INPUT (reported: no picture of a set has a number, or a path that another set has); ERR_USAGE
 *         (reported: two pictures with one name, or with one number and no way to tell them apart); ERR_SYSTEM
 *         (reported)
 */
int set_match(struct set *const *sets, size_t n_sets, int only_numbers);
