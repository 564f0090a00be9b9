/* The kernel interface that the runtime's converter and output files need: nothing. */
#ifndef CH_H
#define CH_H
#endif
