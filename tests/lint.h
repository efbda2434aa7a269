/* Included first into every source that `make lint` reads: contracts that the analyzers cannot see across files. */
#pragma once

#include "base/err.h"

/* It returns its first argument (base/err.h). Without this, `if (!p) err = err_report(ERR_SYSTEM, ...)` leaves open
 * that p is NULL and err 0. */
#define err_report(code, ...) (err_report((code), __VA_ARGS__), (code))
