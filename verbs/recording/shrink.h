/*
 * The smallest set of things with which a test still fails: delta debugging (Zeller and Hildebrandt, Simplifying and
 * Isolating Failure-Inducing Input, 2002), by leaving out ever smaller pieces, from the end to the beginning.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * Test some sets, side by side.
 * @param sets   [n] of [number of things]: 1 where a thing is in
 * @param fails  [n], receives 1 for a set with which the test still fails
 * @return 0 or ERR_* (reported)
 */
typedef int shrink_test(void *user, uint8_t *const *sets, size_t n, int *fails);

/**
 * Leave out what is not needed, until no single thing can be left out. The result does not depend on `at_once`.
 * @param in       [n]: 1 for things that are in, with which the test fails; receives those that are needed
 * @param at_once  sets that are tested at once
 * @return 0 or what a test returned
 */
int shrink(uint8_t *in, size_t n, size_t at_once, shrink_test *test, void *user);
