#include "replay/index/members.h"

#include "layout.h"
#include "replay/index/snapshot_parts.h"

const struct member *members_all(size_t *n)
{
#define SINGLE(owner, member)
#define PLACED(owner, member, type) \
	{ #owner, #member, #type, offsetof(struct owner, member), sizeof(((struct owner *)0)->member), sizeof(type) },
	static const struct member members[] = { SNAPSHOT_MEMBERS(PLACED, SINGLE) };

	*n = sizeof(members) / sizeof(members[0]);
	return members;
}
