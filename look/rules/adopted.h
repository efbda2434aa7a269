/* Converts findings to the structs that rules_load would read from their file. */
#pragma once

#include "look/rules/findings.h"
#include "look/rules/rules.h"

/**
 * @param out  receives the rules, to be freed by config_free with rules_schema; NULL on failure @return 0 or
 * ERR_SYSTEM (reported)
 */
int adopted_create(const struct findings *findings, struct rules **out);
