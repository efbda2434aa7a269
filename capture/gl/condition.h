/* Runs inside the traced program. Conditional rendering: what the query counted, which a trace has no place for. */
#pragma once

/** Before glBeginConditionalRender: write the answer of its query, for which the driver waits in any mode now. */
void condition_write(unsigned query);
