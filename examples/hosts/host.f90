! SPDX-License-Identifier: MIT
!
! host.f90 - two Fortran solvers coupled with waveform.h, iqn.h and rk.h through the module kit
!
! Two masses between three springs, one solver each; both read the other's waveform, quasi-Newton
! closes the loop:
!
!     u1'' + 20 pi^2 u1 = 16 pi^2 u2(t)    Runge-Kutta 4, 5 steps in a window
!     u2'' + 20 pi^2 u2 = 16 pi^2 u1(t)    generalized-alpha, 100 steps in a window
!
! The answer: the largest errors published by Rodenberg and Uekermann, arXiv 2511.07616 (2025),
! cubic, window 0.1.
module solvers
    use kit
    implicit none
    integer, parameter :: dp = c_double
    integer(kit_long), parameter :: one = 1, two = 2
    real(dp), parameter :: pi = 3.14159265358979323846_dp, k12 = 16*pi**2, k = 20*pi**2

    type waveform ! of one number: x, its samples, are a part of mem; c: coefficients
        type(c_ptr) :: w
        real(dp), allocatable :: mem(:), c(:)
        real(dp), pointer :: x(:)
    end type

    type mass ! a solver's whole state: to roll back a window is an assignment
        real(dp) :: u, v, a, error
    end type

contains

    subroutine check(status, message)
        integer(c_int), intent(in) :: status
        type(c_ptr), intent(in) :: message
        if (status >= 0) return
        print '(a)', kit_text(message)
        error stop 1
    end subroutine

    subroutine make(w, degree, capacity)
        type(waveform), intent(inout), target :: w
        integer(c_int), intent(in) :: degree, capacity
        integer(c_int) :: status
        allocate (w%mem(wf_size(one, degree, capacity)/8 + 1), w%c(capacity))
        status = wf_make(w%w, one, degree, capacity, w%mem, 8*size(w%mem, kind=c_size_t))
        call check(status, wf_message(status))
        call c_f_pointer(wf_column(w%w, 0_c_int), w%x, [capacity]) ! column j is x(j + 1)
    end subroutine

    subroutine write(w, t, u)
        type(waveform), intent(inout) :: w
        real(dp), intent(in) :: t, u
        integer(c_int) :: column
        column = wf_push(w%w, t, 0_c_int)
        call check(column, wf_message(column))
        w%x(column + 1) = u
    end subroutine

    subroutine fit(w)
        type(waveform), intent(inout) :: w
        integer(c_int) :: status
        status = wf_fit(w%w, w%c)
        call check(status, wf_message(status))
    end subroutine

    real(dp) function value(w, t)
        type(waveform), intent(in) :: w
        real(dp), intent(in) :: t
        real(dp) :: out(1)
        integer(c_int) :: status
        status = wf_eval(w%w, t, 0_c_int, w%c, out)
        call check(status, wf_message(status))
        value = out(1)
    end function

    subroutine compare(m, t, sign)
        type(mass), intent(inout) :: m
        real(dp), intent(in) :: t, sign
        m%error = max(m%error, abs(m%u - (cos(2*pi*t) + sign*cos(6*pi*t))/2))
    end subroutine

    subroutine runge_kutta(m, t0, h, steps, in, out)
        type(mass), intent(inout) :: m
        real(dp), intent(in) :: t0, h
        integer, intent(in) :: steps
        type(waveform), intent(in) :: in
        type(waveform), intent(inout) :: out
        type(rk_table), pointer :: T
        real(dp), pointer :: c(:)
        real(dp), target :: y(2)
        real(dp) :: z(2), slope(2, 0:3)
        integer(c_int) :: i, status
        integer :: j
        call c_f_pointer(rk_find('rk4' // c_null_char), T)
        call c_f_pointer(T%c, c, [T%stages])
        y = [m%u, m%v]
        do j = 1, steps
            do i = 0, T%stages - 1
                status = rk_stage(T, i, h, two, y, slope, two, z)
                slope(:, i) = [z(2), k12*value(in, t0 + (j - 1)*h + c(i + 1)*h) - k*z(1)]
            end do
            status = rk_update(T, h, two, y, slope, two, c_loc(y), c_null_ptr)
            call check(status, rk_message(status))
            m%u = y(1)
            m%v = y(2)
            call write(out, t0 + j*h, m%u)
            call compare(m, t0 + j*h, 1.0_dp)
        end do
    end subroutine

    subroutine generalized_alpha(m, t0, h, steps, in, out)
        type(mass), intent(inout) :: m
        real(dp), intent(in) :: t0, h
        integer, intent(in) :: steps
        type(waveform), intent(in) :: in
        type(waveform), intent(inout) :: out
        real(dp), parameter :: af = 0.4_dp, am = 0.2_dp
        real(dp), parameter :: gamma = 0.5_dp - am + af, beta = (gamma + 0.5_dp)/4
        real(dp) :: m0, m1, m2, u, a
        integer :: j
        m0 = (1 - am)/(beta*h**2)
        m1 = (1 - am)/(beta*h)
        m2 = (1 - am - 2*beta)/(2*beta)
        do j = 1, steps
            u = k12*value(in, t0 + (j - 1 + 1 - af)*h) - af*k*m%u + m0*m%u + m1*m%v + m2*m%a
            u = u/(k*(1 - af) + m0)
            a = (u - m%u - h*m%v)/(beta*h**2) - (1 - 2*beta)/(2*beta)*m%a
            m%v = m%v + h*((1 - gamma)*m%a + gamma*a)
            m%u = u
            m%a = a
            call write(out, t0 + j*h, u)
            call compare(m, t0 + j*h, -1.0_dp)
        end do
    end subroutine
end module solvers

program host
    use solvers
    implicit none
    integer, parameter :: windows = 10, na = 5, nb = 100
    real(dp), parameter :: window = 1.0_dp/windows
    real(dp), parameter :: e_A = 0.0003007235641515_dp, e_B = 0.0003146352046766_dp
    type(mass) :: A, B, A0, B0
    type(waveform) :: u1, u2, guess ! guess: what A reads in place of u2
    type(c_ptr) :: q
    real(dp), allocatable, target :: mem(:)
    integer(c_int) :: status, first
    integer :: n, j, iterations

    A = mass(1, 0, -k, 0)
    B = mass(0, 0, k12, 0)
    call make(u1, 3, na + 1)
    call make(u2, 3, nb + 1)
    call make(guess, 3, nb + 1)
    allocate (mem(iqn_size(int(nb, kit_long), 20_c_int, 1_c_int)/8 + 1))
    status = iqn_make(q, int(nb, kit_long), 20_c_int, 1_c_int, mem, 8*size(mem, kind=c_size_t))
    call check(status, iqn_message(status))
    status = iqn_set(q, iqn_omega, 1.0_dp)
    status = iqn_set(q, iqn_tol_relative, 1e-11_dp)
    call write(u1, 0.0_dp, A%u)
    call write(u2, 0.0_dp, B%u)
    call write(guess, 0.0_dp, B%u)
    iterations = 0
    do n = 0, windows - 1
        A0 = A
        B0 = B
        do j = 1, nb
            call write(guess, (n + real(j, dp)/nb)*window, B0%u)
        end do
        do
            call fit(guess)
            A = A0
            status = wf_rollback(u1%w)
            call runge_kutta(A, n*window, window/na, na, guess, u1)
            call fit(u1)
            B = B0
            status = wf_rollback(u2%w)
            call generalized_alpha(B, n*window, window/nb, nb, u1, u2)
            first = wf_start(guess%w) + 2 ! what an iteration changes
            status = iqn_step(q, guess%x(first:), u2%x(first:))
            call check(status, iqn_message(status))
            iterations = iterations + 1
            if (iqn_converged(q) /= 0) exit
        end do
        if (iqn_converged(q) /= 1) error stop 'no convergence'
        status = iqn_commit(q)
        status = wf_advance(u1%w, 0_c_int)
        status = wf_advance(u2%w, 0_c_int)
        status = wf_advance(guess%w, 0_c_int)
    end do
    print '(a, es23.16)', 'e_A ', A%error, 'published_e_A ', e_A
    print '(a, es23.16)', 'e_B ', B%error, 'published_e_B ', e_B
    print '(a, f0.1)', 'iterations_average ', real(iterations, dp)/windows
    if (.not. (abs(A%error - e_A) <= 1e-9_dp .and. abs(B%error - e_B) <= 1e-9_dp)) error stop 1
end program
