/* What the runtime's converter and output files need of the kernel: nothing. */
#ifndef CH_H
#define CH_H
#endif
