/*
 * Runs inside the traced program. Conditional rendering: records the query's result, which the format has no place for.
 */
#pragma once

/** Before glBeginConditionalRender: write its query's result. The driver now waits for the result in any mode. */
void condition_write(unsigned query);
