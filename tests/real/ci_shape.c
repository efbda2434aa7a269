/* The library that ci_viewer.c links: which way its triangle faces. */
float shape_facing(void)
{
	return FACING;
}
