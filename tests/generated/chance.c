#include "tests/generated/generated.h"

uint64_t chance_next(struct chance *chance)
{
	uint64_t x = chance->state += 0x9e3779b97f4a7c15u;

	x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
	x = (x ^ x >> 27) * 0x94d049bb133111ebu;
	return x ^ x >> 31;
}

unsigned chance_below(struct chance *chance, unsigned n)
{
	return n ? (unsigned)((chance_next(chance) >> 32) * n >> 32) : 0;
}

int chance_of(struct chance *chance, unsigned one_in)
{
	return chance_below(chance, one_in) == 0;
}

float chance_between(struct chance *chance, float lo, float hi)
{
	return lo + (hi - lo) * (float)(chance_next(chance) >> 40) * 0x1p-24f;
}

void chance_color(struct chance *chance, float color[4])
{
	for (int i = 0; i < 3; i++)
		color[i] = chance_of(chance, 4) ? (float)chance_below(chance, 2) : chance_between(chance, 0, 1);
	color[3] = chance_of(chance, 3) ? chance_between(chance, 0, 1) : 1;
}
